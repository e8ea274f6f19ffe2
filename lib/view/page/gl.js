// Programs, textures and targets of WebGL 2.

const HEADER = '#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n' +
    'precision highp sampler2DArray;\n';

export class Program {
  constructor(gl, name, vertex, fragment) {
    this.gl = gl;
    this.id = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, HEADER + text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
      gl.attachShader(this.id, shader);
    }
    gl.linkProgram(this.id);
    if (!gl.getProgramParameter(this.id, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`${name}: ${gl.getProgramInfoLog(this.id)}`);
    this.uniforms = new Map();
    for (let i = 0; i < gl.getProgramParameter(this.id, gl.ACTIVE_UNIFORMS); ++i) {
      const info = gl.getActiveUniform(this.id, i);
      this.uniforms.set(info.name.replace('[0]', ''), {type: info.type, at: gl.getUniformLocation(this.id, info.name)});
    }
  }

  // Sets uniforms by name; the compiler may have left some out. A texture is {unit, target, id}.
  use(values) {
    const gl = this.gl;
    gl.useProgram(this.id);
    for (const [name, value] of Object.entries(values)) {
      const uniform = this.uniforms.get(name);
      if (!uniform) continue;
      switch (uniform.type) {
        case gl.FLOAT: gl.uniform1f(uniform.at, value); break;
        case gl.FLOAT_VEC2: gl.uniform2fv(uniform.at, value); break;
        case gl.FLOAT_VEC3: gl.uniform3fv(uniform.at, value); break;
        case gl.FLOAT_VEC4: gl.uniform4fv(uniform.at, value); break;
        case gl.FLOAT_MAT3: gl.uniformMatrix3fv(uniform.at, false, value); break;
        case gl.INT: case gl.BOOL: gl.uniform1i(uniform.at, value); break;
        default:
          gl.activeTexture(gl.TEXTURE0 + value.unit);
          gl.bindTexture(value.target, value.id);
          gl.uniform1i(uniform.at, value.unit);
      }
    }
  }
}

// A texture without interpolation, which is read by texel.
export function makeTexture(gl, format, width, height) {
  const id = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, id);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST],
                               [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
    gl.texParameteri(gl.TEXTURE_2D, name, value);
  return id;
}

// A framebuffer of textures. `depth`: true, or the renderbuffer of another one, of the same size.
export class Target {
  constructor(gl, width, height, formats, depth = false) {
    Object.assign(this, {gl, width, height});
    this.id = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.id);
    this.textures = formats.map((format, i) => {
      const id = makeTexture(gl, format, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, id, 0);
      return id;
    });
    gl.drawBuffers(formats.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    if (depth) {
      this.shares = depth !== true;
      this.depth = this.shares ? depth : gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
      if (!this.shares) gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    }
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost())
      throw new Error('this browser cannot draw into float textures');
  }

  bind() {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.id);
    gl.viewport(0, 0, this.width, this.height);
  }

  clear(colour = [0, 0, 0, 0]) {
    this.bind();
    this.textures.forEach((_, i) => this.gl.clearBufferfv(this.gl.COLOR, i, colour));
    if (this.depth && !this.shares) this.gl.clearBufferfv(this.gl.DEPTH, 0, [1]);
  }

  remove() {
    this.textures.forEach((id) => this.gl.deleteTexture(id));
    if (this.depth && !this.shares) this.gl.deleteRenderbuffer(this.depth);
    this.gl.deleteFramebuffer(this.id);
  }
}

// A buffer of vertex attributes.
export function attribute(gl, at, values, components, {divisor = 0, stride = 0, offset = 0, buffer = null} = {}) {
  const id = buffer ?? gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, id);
  if (!buffer) gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(at);
  gl.vertexAttribPointer(at, components, gl.FLOAT, false, stride, offset);
  gl.vertexAttribDivisor(at, divisor);
  return id;
}
