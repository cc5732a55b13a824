// Expectations of each fabric when a handle is pulled, from its recomputed weights.
//
// Weights are shares inside one fabric: linen weighs bending most, and wool takes twice the moment to
// bend. How far a pull reaches goes by the weight of recovery alone, in reverse: the mean move of a sheet
// held by its corners and lifted in the middle has that order over the fifteen. Little weight on stretch
// shows in a pull along the sheet, and as a spike where bending weighs as little.

/** One sentence by name in the fabric file. */
export const EXPECTATIONS: Readonly<Record<string, string>> = {
  'fine cotton':
    'Weighs recovery most, then stretch, and hardly any bending, the least of all fabrics: a pull makes a narrow tent with nothing to round its folds.',
  'coarse cotton (denim)':
    'Shares its weights rather evenly: no one thing gives way first, and a pull has middling reach.',
  canvas:
    'Weighs bending more than anything else and hardly any stretch: a pull lifts a wide, round dome.',
  linen:
    'Weighs hardly any recovery, the least of all fabrics, and bending by the largest share of all fabrics: the whole sheet follows the handle in a wide, round sweep.',
  ramie:
    'Weighs stretch more than anything else, and by the largest share of all fabrics: it keeps its lengths and follows a pull in a wide tent.',
  silk: 'Weighs recovery by the largest share of all fabrics, and hardly any stretch or bending: a pulled handle makes a spike.',
  poplin: 'Weighs recovery far more than stretch and bending: a pull makes a narrow, steep tent.',
  chiffon:
    'Weighs recovery more than stretch and bending together, and these two evenly: a pull makes a narrow tent.',
  spandex:
    'Weighs recovery and bending evenly, but hardly any stretch: folds stay round, and pulled sideways it stretches around the handle.',
  polyester:
    'Shares its weights evenly, the most so of all fabrics: a pull is met by some moving, some stretching and some bending, and has middling reach.',
  nylon:
    'Weighs bending more than anything else and hardly any stretch: folds stay round, and pulled sideways it stretches around the handle.',
  gabardine:
    'Weighs recovery and bending evenly, but hardly any stretch: expect the shape of leather, whose weights are almost its own.',
  leather:
    'Weighs recovery and bending evenly, but hardly any stretch: expect the shape of gabardine, whose weights are almost its own.',
  wool: 'Weighs bending more than anything else, and recovery almost as much: folds stay round, and a pull has middling reach.',
  velvet:
    'Weighs bending more than anything else, and stretch more than wool does: folds stay round, and a pull reaches farther than in wool.',
};
