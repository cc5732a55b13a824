// Files for the visitor.

/** Wavefront OBJ of triangles, places in metres to a hundredth of a millimetre. */
export function objText(positions: Float32Array, triangles: Uint32Array): string {
  const lines: string[] = [];
  for (let at = 0; at < positions.length; at += 3) {
    const place = [...positions.subarray(at, at + 3)].map((metres) => metres.toFixed(5));
    lines.push(`v ${place.join(' ')}`);
  }
  for (let at = 0; at < triangles.length; at += 3) {
    const corners = [...triangles.subarray(at, at + 3)].map((vertex) => vertex + 1);
    lines.push(`f ${corners.join(' ')}`);
  }
  return `${lines.join('\n')}\n`;
}

export function save(name: string, content: Blob): void {
  const anchor = document.createElement('a');
  anchor.href = URL.createObjectURL(content);
  anchor.download = name;
  anchor.click();
  URL.revokeObjectURL(anchor.href);
}
