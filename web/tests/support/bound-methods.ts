/** The methods that Embind itself gives to every class. */
const INHERITED = ['constructor', 'isAliasOf', 'clone', 'isDeleted', 'deleteLater'];

/** The methods of each class that a module binds, by name, sorted. */
export function boundMethods(module: object): Record<string, string[]> {
  const bound: Record<string, string[]> = {};
  for (const [name, value] of Object.entries(module)) {
    if (typeof value !== 'function' || !/^[A-Z][a-z]/.test(name)) continue;
    const { prototype } = value as { prototype: object };
    if (prototype instanceof Error) continue; // Embind's own
    const prototypes = [prototype, Object.getPrototypeOf(prototype)];
    const methods = prototypes.flatMap((owner) => Object.getOwnPropertyNames(owner));
    bound[name] = [...new Set(methods)]
      .filter((method) => !INHERITED.includes(method) && !(method in Object.prototype))
      .sort();
  }
  return bound;
}
