// Files that belong to the page: beside it, or within it where the page is one file. All are packed by gzip.

async function unpacked(bytes) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes; // a server that says how a file is packed had it unpacked
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The bytes of the file `name`. */
export async function part(name) {
  const within = document.getElementById(`part-${name}`);
  if (within) return unpacked(Uint8Array.from(atob(within.textContent), (letter) => letter.charCodeAt(0)));
  const answer = await fetch(`${name}.gz`);
  if (!answer.ok) throw new Error(`a file of this page is missing: ${name}.gz (${answer.status})`);
  return unpacked(new Uint8Array(await answer.arrayBuffer()));
}

export async function textPart(name) {
  return new TextDecoder().decode(await part(name));
}
