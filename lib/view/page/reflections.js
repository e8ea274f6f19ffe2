// What mirrors and glass reflect: by views in flat ones, else by cube maps.
import {Mirrors} from './mirrors.js';
import {Surroundings} from './surroundings.js';

export class Reflections {
  constructor(gl, scene, mesh, size) {
    Object.assign(this, {gl, mesh, mirrors: new Mirrors(gl, scene.mirror, mesh, size), surroundings: new Surroundings(gl, scene, mesh)});
  }

  // Draws what is to be reflected in a view. Cube maps wait for the shadows of all lamps.
  prepare(drawing, eye, view, accuracy) {
    if (!this.mesh.shiny.length) return;
    this.mirrors.prepare(drawing, eye, view, accuracy);
    const ready = drawing.records.holdsDirect || drawing.lamps.drawn === drawing.lamps.places.length;
    if (ready || !this.surroundings.others) this.surroundings.prepare(drawing, accuracy, `${ready} ${accuracy}`, this.mirrors.taken);
  }

  // Adds the reflections to the light of the view that was drawn last.
  shine(program, target, view) {
    if (!target) return;
    const gl = this.gl;
    target.bind();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.depthMask(false);
    this.mirrors.shine(this.mesh, program, view);
    this.surroundings.shine(program, view);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
