// What panes leave of the light of a place of a lamp: the product of all panes along each way, and the distance of the
// nearest. Surfaces between two panes one behind the other get the light that passes both.

function textureArray(gl, format, size, layers) {
  const id = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, id);
  gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, format, size, size, layers);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, name, gl.NEAREST);
  return id;
}

// {shares, depths}: a layer for each face of the place (lamps.js).
export function drawVeils(gl, mesh, program, place, size) {
  const shares = textureArray(gl, gl.RGBA16F, size, place.axes.length);
  const depths = textureArray(gl, gl.DEPTH_COMPONENT32F, size, place.axes.length);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.viewport(0, 0, size, size);
  gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
  place.axes.forEach((axes, face) => {
    gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, shares, 0, face);
    gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, depths, 0, face);
    gl.drawBuffers([gl.COLOR_ATTACHMENT0]);
    gl.clearBufferfv(gl.COLOR, 0, [1, 1, 1, 1]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    const view = {eye: place.eye, axes, lens: place.lens, range: [place.nearest, place.farthest], perspective: place.perspective};
    gl.colorMask(false, false, false, false);
    mesh.draw(program, view, mesh.panes);
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    gl.depthFunc(gl.ALWAYS);
    gl.depthMask(false);
    mesh.draw(program, view, mesh.panes);
    gl.depthMask(true);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
  });
  gl.deleteFramebuffer(framebuffer);
  return {shares, depths};
}
