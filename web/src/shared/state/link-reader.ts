// The parts of a link, each by itself. One that cannot be read gives its default and one sentence.

/** A name as it stands in a link: lower case, hyphens. */
export function slug(name: string): string {
  return name
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, '-')
    .replace(/^-|-$/g, '');
}

export type LinkReader = ReturnType<typeof createLinkReader>;

/** Reads one part of the link at a time, of this view where it names one, and collects what was wrong with it. */
export function createLinkReader(hash: string, view?: string) {
  const parameters = new URLSearchParams(hash.replace(/^#/, ''));
  const problems: string[] = [];
  const known = new Set<string>();

  function take<Value>(
    key: string,
    fallback: Value,
    expected: string,
    parse: (text: string) => Value | undefined,
  ): Value {
    known.add(key);
    const text = parameters.get(key);
    if (text === null) return fallback;
    const value = parse(text);
    if (value !== undefined) return value;
    problems.push(`${key}: expected ${expected}, found "${text.slice(0, 40)}"`);
    return fallback;
  }

  function takeSwitch(key: string, isUsual = false): boolean {
    return take(key, isUsual ? 'on' : 'off', 'on or off', oneOf(['on', 'off'])) === 'on';
  }

  function finish(): string[] {
    for (const key of new Set(parameters.keys())) {
      if (!known.has(key)) problems.push(`${key.slice(0, 40)}: not a known part`);
    }
    return problems;
  }

  if (view !== undefined) take('view', view, view, oneOf([view]));
  return { take, takeSwitch, finish };
}

export function oneOf<Value extends string | number>(values: readonly Value[]) {
  return (text: string): Value | undefined => values.find((value) => String(value) === text);
}
