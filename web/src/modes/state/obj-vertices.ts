// The places of an OBJ text's vertices, for a key whose triangles are the model's.

/** Three numbers a vertex, in the order of the text. */
export function verticesIn(text: string): Float64Array {
  const places: number[] = [];
  for (const [, x, y, z] of text.matchAll(/^[ \t]*v[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)/gm))
    places.push(Number(x), Number(y), Number(z));
  return Float64Array.from(places);
}
