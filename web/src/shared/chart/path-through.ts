// Lines of charts.

/** The path through the points, with gaps where there is none. */
export function pathThrough(points: readonly (readonly [number, number] | null)[]): string {
  let isOpen = false;
  return points
    .map((point) => {
      const command = isOpen ? 'L' : 'M';
      isOpen = point !== null;
      return point ? `${command}${point[0].toFixed(1)} ${point[1].toFixed(1)}` : '';
    })
    .join('');
}
