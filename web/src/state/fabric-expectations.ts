// What to expect of each fabric when a handle is pulled, as its weights have it.

/** One sentence by name in the fabric file. */
export const EXPECTATIONS: Readonly<Record<string, string>> = {};
