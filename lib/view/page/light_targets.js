// The framebuffers that the sets of caches share in one view of the scene.
import {Target} from './gl.js';

// surfaces: the G-buffer; scratch: records of one group of lamps; veil: the share of light that comes through panes;
// shine: light that mirrors and panes reflect. veil and shine are null where the scene has none.
export function lightTargets(gl, width, height, {panes, shine}) {
  const float = gl.RGBA32F, one = (there, depth) => there ? new Target(gl, width, height, [float], depth) : null;
  const surfaces = new Target(gl, width, height, [float, float, float, float], true);
  return {surfaces, scratch: one(true), veil: one(panes, surfaces.depth), shine: one(shine, surfaces.depth)};
}

export function removeTargets(targets) {
  for (const target of Object.values(targets)) target?.remove();
}
