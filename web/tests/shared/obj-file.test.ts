import { describe, expect, it } from 'vitest';
import {
  MOST_MEGABYTES,
  MOST_VERTICES,
  type ObjFile,
  oddSize,
  openObjFile,
  textInMetres,
} from '../../src/shared/state/obj-file';

const open = (text: string, name = 'hat.obj') => openObjFile(new File([text], name));

async function opened(text: string): Promise<ObjFile> {
  const file = await open(text);
  if (typeof file === 'string') throw new Error(file);
  return file;
}

describe('obj-file', () => {
  it('knows the ends of the mesh, and no other statement for a vertex', async () => {
    const { low, high } = await opened(
      'vt 9 9\nvn 9 9 9\n v 1 -2 3 1 0 0\r\nv\t4 5 -6\n# v 9 9 9\n',
    );
    expect([low, high]).toEqual([
      [1, -2, -6],
      [4, 5, 3],
    ]);
  });

  it('takes no other file, none too large, and none of too many vertices', async () => {
    expect(await open('solid', 'hat.stl')).toContain('is no OBJ file');
    const large = '#'.repeat(1e6 * MOST_MEGABYTES + 1);
    expect(await open(large)).toMatch(/hat\.obj has 21 MB, and 20 MB are taken at most/);
    const many = 'v 0 0 0\n'.repeat(MOST_VERTICES + 1);
    expect(await open(many)).toMatch(/has 200.001 vertices, and 200.000 are taken at most/);
    expect(typeof (await open('v 0 0 0\n'.repeat(MOST_VERTICES)))).toBe('object');
  });

  it('scales vertices alone, with what follows them', async () => {
    const file = await opened(
      'v 1000 -20 3e2 0.5 0.5 0.5\nvt 100 200\nv 1 \\\n2 3\nf 1/1 2/1 1/1\n',
    );
    expect(textInMetres(file, 'm')).toBe(file.text);
    expect(textInMetres(file, 'mm')).toBe(
      'v 1 -0.02 0.3 0.5 0.5 0.5\nvt 100 200\nv 0.001 0.002 0.003\nf 1/1 2/1 1/1\n',
    );
    expect(textInMetres(file, 'inch')).toContain('v 25.4 -0.508 7.62');
  });

  it.each([
    [950, 'm', /^It is 950 m across.*probably the millimetre/],
    [95, 'm', /probably the centimetre/],
    [40, 'm', /probably the inch/],
    [1.2, 'm', null],
    [0.01, 'm', null],
    [0.004, 'm', /^It is 4 mm across, which is odd for cloth\.$/],
    [1.2, 'mm', /^It is 1\.2 mm across.*probably the metre/],
    [950, 'mm', null],
  ] as const)('of %f in %s says %s', (size, unit, sentence) => {
    const box = { low: [0, 0, 0], high: [size / 2, size, 0] } as const;
    const said = oddSize({ low: [...box.low], high: [...box.high] }, unit);
    if (sentence === null) expect(said).toBeNull();
    else expect(said).toMatch(sentence);
  });
});
