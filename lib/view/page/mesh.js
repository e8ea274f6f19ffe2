// The triangles of the scene, with their materials.
import {attribute} from './gl.js';
import {row} from './vector.js';

const NONE = 0xffffffff;
const TWO_SIDED = 1, MASKED = 2, CLEAR = 4;  // MaterialFlag
const SHARES = 99;                           // numbers of a row of `specular`

export class Mesh {
  constructor(gl, scene) {
    this.gl = gl;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    attribute(gl, 0, scene.vertex.position, 3);
    attribute(gl, 1, scene.vertex.normal, 3);
    if (scene.vertex.uv.length) attribute(gl, 2, scene.vertex.uv, 4);
    if (scene.vertex.colour.length) attribute(gl, 3, scene.vertex.colour, 4);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, scene.triangle.corner, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.textures = this.#makeTextures(scene);
    this.materials = Array.from({length: scene.material.rows}, (_, i) => this.#material(scene, i));
    this.parts = Array.from({length: scene.part.rows}, (_, i) => ({
      first: scene.part.first_triangle[i], count: scene.part.triangle_count[i], material: scene.part.material[i],
      mirror: scene.part.mirror[i], lamp: scene.part.lamp[i],
    }));
    this.panes = this.parts.filter((part) => this.materials[part.material].clear);
    this.shiny = this.parts.filter((part) => this.materials[part.material].shiny);
    this.parts = this.parts.filter((part) => !this.materials[part.material].clear);
  }

  #makeTextures({texture, texel}) {
    const gl = this.gl;
    const wraps = [gl.REPEAT, gl.CLAMP_TO_EDGE, gl.MIRRORED_REPEAT];
    return Array.from({length: texture.rows}, (_, i) => {
      const id = gl.createTexture(), width = texture.width[i], height = texture.height[i];
      gl.bindTexture(gl.TEXTURE_2D, id);
      gl.texImage2D(gl.TEXTURE_2D, 0, texture.srgb[i] ? gl.SRGB8_ALPHA8 : gl.RGBA8, width, height, 0, gl.RGBA,
                    gl.UNSIGNED_BYTE, texel.rgba.subarray(4 * texture.first_texel[i], 4 * (texture.first_texel[i] + width * height)));
      const nearest = texture.nearest[i];
      if (!nearest) gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, nearest ? gl.NEAREST : gl.LINEAR_MIPMAP_LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, nearest ? gl.NEAREST : gl.LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wraps[texture.wrap[2 * i]]);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wraps[texture.wrap[2 * i + 1]]);
      return id;
    });
  }

  // The uniforms of holes.glsl, gbuffer.frag.glsl, veil.frag.glsl and shine.frag.glsl.
  #material({material: m, specular}, i) {
    const flags = m.flags[i], colour = m.colour_texture[i], emission = m.emission_texture[i];
    const map = (unit, texture) => ({unit, target: this.gl.TEXTURE_2D, id: texture === NONE ? null : this.textures[texture]});
    const table = (values) => m.specular[i] === NONE ? new Float32Array(SHARES)
                                                                 : values.subarray(SHARES * m.specular[i], SHARES * (m.specular[i] + 1));
    const reflects = table(specular.reflects);
    return {
      clear: (flags & CLEAR) !== 0,
      shiny: reflects.some((share) => share > 0), reflectance: Math.max(...reflects.slice(-3)),
      masked: (flags & MASKED) !== 0,
      uniforms: {
        masked: (flags & MASKED) !== 0, two_sided: (flags & TWO_SIDED) !== 0, cutoff: m.cutoff[i],
        diffuse: row(m.diffuse, i, 4), gloss: row(m.gloss, i), emission: row(m.emission, i),
        colour_textured: colour !== NONE, colour_set: m.colour_set[i], colour_place: row(m.colour_place, i, 6),
        colour_map: map(0, colour),
        emission_textured: emission !== NONE, emission_set: m.emission_set[i],
        emission_place: row(m.emission_place, i, 6), emission_map: map(1, emission),
        material: i + 1, reflects, passes: table(specular.passes),
      },
    };
  }

  // Some of its parts, as far as nothing that is drawn already stands before them.
  draw(program, view, parts = this.parts) {
    const gl = this.gl;
    gl.bindVertexArray(this.array);
    gl.vertexAttrib4f(2, 0, 0, 0, 0);
    gl.vertexAttrib4f(3, 1, 1, 1, 1);
    gl.enable(gl.DEPTH_TEST);
    program.use(view);
    let last = -1, lamp = -1;
    for (const part of parts) {
      if (part.material !== last) program.use(this.materials[last = part.material].uniforms);
      if (part.lamp !== lamp) program.use({lamp_number: (lamp = part.lamp) === NONE ? 0 : lamp + 1});
      gl.drawElements(gl.TRIANGLES, 3 * part.count, gl.UNSIGNED_INT, 12 * part.first);
    }
    gl.bindVertexArray(null);
    gl.disable(gl.DEPTH_TEST);
  }
}
