// Takes the place of what the C++ library's locale names for dates and the environment: nothing of Pleat formats a date.
mergeInto(LibraryManager.library, {
  strftime: function () { return 0; },
  strftime_l: function () { return 0; },
  environ_get: function () { return 0; },
  environ_sizes_get: function (count, size) {
    HEAPU32[count >> 2] = 0;
    HEAPU32[size >> 2] = 0;
    return 0;
  },
});
