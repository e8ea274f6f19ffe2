// The files of the page: from the server, or from a page that holds them itself (view/static/static_page.h).
import {unpack} from './unpack.js';

// Is there a server?
export const served = document.getElementById('/scene.bin') === null;

function inflated(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')));
}

// A file by its path, `as` json, text or arrayBuffer.
export async function load(path, as) {
  const held = document.getElementById(path);
  const response = held ? inflated(held.textContent) : await fetch(path);
  if (!response.ok) throw new Error(`${path}: ${response.status} ${response.statusText}`);
  held?.remove();
  return held?.dataset.form === 'packed' ? unpack(await response.arrayBuffer()) : response[as]();
}
