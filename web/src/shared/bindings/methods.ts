// The list of a bound class's methods, which a test holds against the real module.

/** Lists the keys of `Handle`; a missing or a surplus name does not compile. */
export function methodsOf<Handle>(names: Record<keyof Handle, true>): string[] {
  return Object.keys(names).sort();
}
