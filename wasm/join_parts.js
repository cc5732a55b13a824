// Makes one instance of the parts that the module is fetched in. The caller has compiled them: [first] or [first, rest].
Module['instantiateWasm'] = (imports, receive) => {
  const [first, rest] = Module['parts'];
  // Stands for each function of the rest until that is there.
  const missing = () => {
    throw new Error('This part of the core was not loaded.');
  };
  const placeholder = new Proxy({}, { get: () => missing });
  const join = async (instance) => {
    const add = (part) => WebAssembly.instantiate(part, { primary: instance.exports });
    if (rest) await add(rest);
    else Module['join'] = add; // joins the rest later
    receive(instance);
  };
  WebAssembly.instantiate(first, { placeholder, ...imports }).then(join).catch(readyPromiseReject);
  return {};
};
