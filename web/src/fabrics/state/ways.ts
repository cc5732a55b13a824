// The ways of looking at fabrics, and which one a link is of.
import type { createLinkReader } from '../../shared/state/link-reader';
import { oneOf } from '../../shared/state/link-reader';

export const WAYS = ['strips', 'shapes', 'pair'] as const;
export type WayId = (typeof WAYS)[number];

/** The way of a link: what it says, else shapes where it says anything of them, else strips. */
export function wayIn(hash: string): WayId {
  const parameters = new URLSearchParams(hash.replace(/^#/, ''));
  const named = oneOf(WAYS)(parameters.get('show') ?? '');
  const others = [...parameters.keys()].filter((key) => key !== 'view' && key !== 'show');
  return named ?? (others.length > 0 ? 'shapes' : 'strips');
}

/** Takes the part of a link that names its way. */
export function takeWay({ take }: Pick<ReturnType<typeof createLinkReader>, 'take'>): void {
  take<WayId>('show', 'strips', WAYS.join(', '), oneOf(WAYS));
}
