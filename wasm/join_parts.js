// Makes one instance of the parts that the module is fetched in. The caller has compiled them: [first] or [first, rest].
Module['instantiateWasm'] = function (imports, receive) {
  var first = Module['parts'][0];
  var rest = Module['parts'][1];
  // Takes the place of each function of the rest until that is there.
  var placeholder = {};
  WebAssembly.Module.imports(first).forEach(function (item) {
    if (item.module !== 'placeholder') return;
    placeholder[item.name] = function () {
      throw new Error('This part of the core was not loaded.');
    };
  });
  WebAssembly.instantiate(first, Object.assign({ placeholder: placeholder }, imports)).then(function (instance) {
    if (!rest) return receive(instance);
    return WebAssembly.instantiate(rest, { primary: instance.exports }).then(function () {
      receive(instance);
    });
  });
  return {};
};
