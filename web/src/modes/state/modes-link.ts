// The view of modes to a link and back: model, energy, the mix of modes, and the keys that can be made again.
import { createLinkReader, oneOf } from '../../shared/state/link-reader';
import type { Energy, VolumeChoice } from '../bindings/modal-module';
import { DRAPE_FRAMES, type KeyOrigin, MOST_DEGREES } from './key-shapes';
import { BAR_CELLS, MODELS } from './models';
import {
  COUNTS,
  energiesOf,
  type ModesLink,
  type ModesState,
  type Showing,
  usualLink,
} from './modes-state';
import { MOST_KEYS } from './timeline';

/** Steps of a slider: what a link can tell apart. */
const DIGITS = 3;

const MOST_MODES = Math.max(...COUNTS);
const VOLUMES: readonly VolumeChoice[] = ['auto', 'lattice', 'shell'];
const SHOWINGS: readonly Showing[] = ['modes', 'keys'];

function mixText(amplitudes: readonly number[]): string {
  return amplitudes
    .map((amplitude, mode) => [mode + 1, Number(amplitude.toPrecision(DIGITS))] as const)
    .filter(([, amplitude]) => amplitude !== 0)
    .map(([mode, amplitude]) => `${mode}:${amplitude}`)
    .join('_');
}

/** "1:0.5_3:-0.2": half of the first mode, a fifth of the third backwards. */
function mixIn(text: string): number[] | undefined {
  const amplitudes: number[] = [];
  for (const part of text === '' ? [] : text.split('_')) {
    const [, mode, amplitude] = /^(\d{1,2}):(-?\d*\.?\d+)$/.exec(part) ?? [];
    const index = Number(mode) - 1;
    if (!(index >= 0 && index < MOST_MODES) || !(Math.abs(Number(amplitude)) <= 1))
      return undefined;
    while (amplitudes.length <= index) amplitudes.push(0);
    amplitudes[index] = Number(amplitude);
  }
  return amplitudes;
}

function keyText(origin: KeyOrigin): string | null {
  switch (origin.kind) {
    case 'rest':
      return 'rest';
    case 'bent':
      return `bent-${origin.degrees}`;
    case 'mix':
      return `${origin.energy}-${mixText(origin.amplitudes)}`;
    case 'drape':
      return `frame-${origin.frame}`;
    case 'file':
      return null;
  }
}

function keyIn(text: string, model: string): KeyOrigin | undefined {
  if (text === 'rest') return { kind: 'rest' };
  const [, kind = '', rest = ''] = /^([a-z]+)-(.*)$/.exec(text) ?? [];
  const number = /^\d{1,3}$/.test(rest) ? Number(rest) : Number.NaN;
  if (kind === 'bent' && number <= MOST_DEGREES) return { kind, degrees: number };
  if (kind === 'frame' && model === 'cloth' && number < DRAPE_FRAMES)
    return { kind: 'drape', frame: number };
  const energy = energiesOf(model).find((one): one is Energy => one === kind);
  const amplitudes = mixIn(rest);
  return energy && amplitudes && { kind: 'mix', energy, amplitudes };
}

function keysIn(text: string, model: string): KeyOrigin[] | undefined {
  const keys = text.split(';').map((part) => keyIn(part, model));
  const known = keys.filter((key) => key !== undefined);
  const fits = known.length === keys.length && keys.length >= 2 && keys.length <= MOST_KEYS;
  return fits ? known : undefined;
}

/** True where a link leaves out some of the keys. */
export function hasUnlinkedKeys({ keys }: Pick<ModesState, 'keys'>): boolean {
  return keys.some(({ origin }) => keyText(origin) === null);
}

/** The part of a link after `#`. */
export function encodeModesLink(state: ModesState): string {
  const keys = state.keys.map(({ origin }) => keyText(origin)).filter((text) => text !== null);
  const onOff = (value: boolean) => (value ? 'on' : 'off');
  const parts: [string, string][] = [
    ['view', 'modes'],
    ['model', state.model],
    ['cells', String(state.cells)],
    ['volume', state.volume],
    ['energy', state.energy],
    ['both', onOff(state.compares)],
    ['count', String(state.count)],
    ['mix', mixText(state.amplitudes)],
    ['show', state.showing],
    ['time', String(Number(state.time.toFixed(DIGITS)))],
    ['ghost', onOff(state.ghost)],
    ['edges', onOff(state.edges)],
  ];
  if (keys.length >= 2) parts.push(['keys', keys.join(';')]);
  return parts.map(([key, value]) => `${key}=${value}`).join('&');
}

/** The state a link stands for; `problems` says in words what could not be read. */
export function decodeModesLink(hash: string): { link: ModesLink; problems: string[] } {
  const { take, takeSwitch, finish } = createLinkReader(hash, 'modes');
  const ids = MODELS.map(({ id }) => id);
  const expected = `${ids.join(', ')} (a link carries no OBJ)`;
  const usual = usualLink(take('model', ids[0] ?? '', expected, oneOf(ids)));
  const energies = energiesOf(usual.model);
  const keys = take(
    'keys',
    usual.keys,
    `2 to ${MOST_KEYS} of rest, bent-180, volume-1:0.5 and the like`,
    (text) => keysIn(text, usual.model),
  );
  const last = keys.length - 1;
  const link: ModesLink = {
    model: usual.model,
    cells: take('cells', usual.cells, BAR_CELLS.join(', '), oneOf(BAR_CELLS)),
    volume: take('volume', usual.volume, VOLUMES.join(', '), oneOf(VOLUMES)),
    energy: take('energy', usual.energy, energies.join(', '), oneOf(energies)),
    compares: takeSwitch('both', usual.compares),
    count: take('count', usual.count, COUNTS.join(', '), oneOf(COUNTS)),
    amplitudes: take('mix', usual.amplitudes, 'modes with amplitudes, as 1:0.5_3:-0.2', mixIn),
    showing: take('show', usual.showing, SHOWINGS.join(', '), oneOf(SHOWINGS)),
    time: take('time', Math.min(usual.time, last), `0 to ${last}`, (text) => {
      const time = text.trim() === '' ? Number.NaN : Number(text);
      return time >= 0 && time <= last ? time : undefined;
    }),
    ghost: takeSwitch('ghost', usual.ghost),
    edges: takeSwitch('edges', usual.edges),
    keys,
  };
  return { link, problems: finish() };
}
