// Takes the place of what lets bindings pass wide strings: none of Pleat's does, and their encodings weigh.
mergeInto(LibraryManager.library, {
  _embind_register_std_wstring__deps: [],
  _embind_register_std_wstring: function () {},
});
