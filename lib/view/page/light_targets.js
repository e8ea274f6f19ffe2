// The framebuffers of one view of the scene.
import {Target} from './gl.js';

// surfaces: the G-buffer; direct: illuminance by lamps, and their light in gloss; splat: irradiance records; gloss: radiance records; veil: the share of
// light that comes through panes; shine: light that mirrors and panes reflect. gloss, veil and shine are null where the
// scene has none.
export function lightTargets(gl, width, height, {gloss, panes, shine}) {
  const float = gl.RGBA32F, one = (there, depth) => there ? new Target(gl, width, height, [float], depth) : null;
  const surfaces = new Target(gl, width, height, [float, float, float, float], true);
  return {
    surfaces, direct: new Target(gl, width, height, [float, float]), splat: one(true), gloss: one(gloss),
    veil: one(panes, surfaces.depth), shine: one(shine, surfaces.depth),
  };
}

export function removeTargets(targets) {
  for (const target of Object.values(targets)) target?.remove();
}
