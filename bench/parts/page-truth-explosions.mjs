// Settings that explode, as a visitor of the page meets them: whether each is told, and whether what
// the page has tried and offers then heals it at the first press. The page's own code plays and mends.
import { tell } from './bench-options.mjs';
import { atLeast, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

export function explosions() {
  tell('explosions, played and mended by the page');
  const rows = askPage('explosions');
  const told = rows.filter((row) => row.told !== null).length;
  const healed = rows.filter((row) => row.healed).length;
  const goOn = rows.filter(({ begin_s: begin }) => begin > 0).length;
  const columns = {
    setting: ({ link }) => link.slice(1).replaceAll('&', ' '),
    told: ({ told: kind }) => kind ?? '-',
    offered: ({ offered }) => offered ?? '-',
    'goes on from': ({ begin_s: begin }) => (begin > 0 ? `${begin.toFixed(2)} s` : '-'),
    'told then': ({ healed: isHealed, left }) => left ?? (isHealed ? '-' : 'no end'),
  };
  return {
    rows,
    goals: [
      atLeast('explosions_told', told, 20, rows),
      atLeast('healed_at_first_press', healed, 19, rows),
      // The others are wrong from their first tenth of a second on.
      atLeast('remedies_that_go_on', goOn, 8, rows),
    ],
    text: `${rows.length} settings that explode, and 4 s with what is offered\n\n${table(rows, columns)}`,
  };
}
