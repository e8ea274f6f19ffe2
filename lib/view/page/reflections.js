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
    const ready = !drawing.needsLamps || drawing.lamps.drawn === drawing.lamps.places.length;
    if (ready || !this.surroundings.others) this.surroundings.prepare(drawing, accuracy, `${ready} ${accuracy} ${drawing.sets[0].weights}`, this.mirrors.taken);
  }

  // Adds the reflections to the light of the view that was drawn last: first of mirrors, of which panes before them
  // take their share (`veil` draws it), then of panes.
  shine(program, veil, target, view) {
    if (!target) return;
    const gl = this.gl;
    target.bind();
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    for (const clear of [false, true]) {
      gl.blendFunc(gl.ONE, gl.ONE);
      const drawn = (part) => this.mesh.materials[part.material].clear === clear;
      this.mirrors.shine(this.mesh, program, view, drawn);
      this.surroundings.shine(program, view, drawn);
      gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
      if (!clear) this.mesh.draw(veil, view, this.mesh.panes);
    }
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
