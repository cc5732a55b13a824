// How each fabric looks. Colours are the fabric file's words made visible; roughness and sheen are
// chosen by eye so that the fabrics differ before they move. None of this enters the computation.

export interface FabricLook {
  front: string;
  back: string;
  /** 0 mirror, 1 chalk. */
  roughness: number;
  /** Strength of the soft light that fibres standing up give at grazing angles, 0 to 1. */
  sheen: number;
  sheenColour: string;
  /** Thin weaves let some of what is behind them through: 1 is opaque. */
  opacity: number;
}

/** How wide the sheen spreads: as wide as velvet's on all, as only its strength tells them apart. */
export const SHEEN_ROUGHNESS = 0.4;

function look(
  front: string,
  back: string,
  roughness: number,
  sheen: number,
  sheenColour: string,
  opacity = 1,
): FabricLook {
  return { front, back, roughness, sheen, sheenColour, opacity };
}

/** Ordered by id in the fabric file: front, back, roughness, sheen and its colour, opacity. */
const LOOKS: readonly FabricLook[] = [
  look('#3a9db8', '#9fcfd9', 0.85, 0.25, '#d9f2f7'), // fine cotton, lake blue
  look('#34548a', '#a9b6cc', 0.95, 0.1, '#93a7cc'), // denim, blue with a pale wrong side
  look('#8ab4d6', '#bcd3e6', 1.0, 0.05, '#e6f1fa'), // canvas, light blue
  look('#d9c6a0', '#c2ad85', 0.95, 0.1, '#fff4dc'), // linen, beige
  look('#e58a3c', '#f0b98a', 0.8, 0.15, '#ffe0c2'), // ramie, orange
  look('#b5202f', '#d9606a', 0.32, 0.6, '#ff9a9a'), // silk, red
  look('#27406e', '#5c739e', 0.7, 0.2, '#9fb4dd'), // poplin, dark blue
  look('#eba6bb', '#f4ccd8', 0.75, 0.4, '#ffe9f0', 0.82), // chiffon, pink
  look('#26272c', '#4a4c54', 0.5, 0.5, '#8d93a6'), // spandex, black
  look('#e3bd3a', '#efd98a', 0.55, 0.3, '#fff3bf'), // polyester, yellow
  look('#3453c4', '#7d92df', 0.42, 0.4, '#b9c6ff'), // nylon, royal blue
  look('#8a2457', '#b9658f', 0.75, 0.25, '#e0a3c2'), // gabardine, purple red
  look('#6d4426', '#b08d6c', 0.45, 0.1, '#d9b38c'), // leather, brown
  look('#2f6b45', '#5f9272', 1.0, 0.7, '#a9d6b8'), // wool, green
  look('#7fae5f', '#5d7f4a', 0.9, 1.0, '#e3ffce'), // velvet, light green
];

/** Grey and matt, for an id that the table has not. */
const PLAIN = look('#8a8f98', '#b5b9c0', 0.9, 0, '#ffffff');

export function lookOf(fabricId: number): FabricLook {
  return LOOKS[fabricId] ?? PLAIN;
}
