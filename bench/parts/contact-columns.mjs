// Columns of rows that have a scene with self-contact beside the same without.

export const kTimes = {
  'ms/frame': 'ms_per_frame',
  'ms without': 'ms_per_frame_without',
  'us/face': 'us_per_face',
};

export const kStretches = {
  'stretch %': (row) => 100 * row.largest_stretch,
  'stretch without %': (row) => 100 * row.largest_stretch_without,
};
