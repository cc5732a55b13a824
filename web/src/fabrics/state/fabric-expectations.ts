// What to expect of each fabric when a handle is pulled, as its recomputed weights have it.
//
// How far a pull reaches goes by the weight of recovery alone, in reverse: the mean move of a sheet
// held by its corners and lifted in the middle has that order over the fifteen. Little weight
// on stretch shows in a pull along the sheet, and as a spike where bending weighs as little.

/** One sentence by name in the fabric file. */
export const EXPECTATIONS: Readonly<Record<string, string>> = {
  'fine cotton':
    'Goes back to where it lay and resists stretch, but hardly resists bending, the least of all fabrics: a pull makes a narrow tent with nothing to round its folds.',
  'coarse cotton (denim)':
    'Shares its weights rather evenly: no one thing gives way first, and a pull has middling reach.',
  canvas:
    'Resists bending more than anything else and hardly resists stretch: a pull lifts a wide, round dome.',
  linen:
    'Hardly goes back, the least of all fabrics, and resists bending, the most of all fabrics: the whole sheet follows the handle in a wide, round sweep.',
  ramie:
    'Resists stretch more than anything else, and the most of all fabrics: it keeps its lengths and follows a pull in a wide tent.',
  silk: 'Goes back to where it lay, the most of all fabrics, and hardly resists stretch or bending: a pulled handle makes a spike.',
  poplin:
    'Goes back to where it lay far more than it resists stretch or bending: a pull makes a narrow, steep tent.',
  chiffon:
    'Goes back to where it lay more than it resists stretch and bending together, and these two evenly: a pull makes a narrow tent.',
  spandex:
    'Goes back and resists bending evenly, but hardly resists stretch: folds stay round, and pulled sideways it stretches around the handle.',
  polyester:
    'Shares its weights evenly, the most so of all fabrics: a pull is met by some moving, some stretching and some bending, and has middling reach.',
  nylon:
    'Resists bending more than anything else and hardly resists stretch: folds stay round, and pulled sideways it stretches around the handle.',
  gabardine:
    'Goes back and resists bending evenly, but hardly resists stretch: expect the shape of leather, whose weights are almost its own.',
  leather:
    'Goes back and resists bending evenly, but hardly resists stretch: expect the shape of gabardine, whose weights are almost its own.',
  wool: 'Resists bending more than anything else, and goes back almost as much: folds stay round, and a pull has middling reach.',
  velvet:
    'Resists bending more than anything else, and stretch more than wool does: folds stay round, and a pull reaches farther than in wool.',
};
