import { describe, expect, it } from 'vitest';
import type { TermNumbers } from '../../src/fabrics/bindings/deform-module';
import { TERMS, type Term } from '../../src/fabrics/state/deform-state';
import { EXPECTATIONS } from '../../src/fabrics/state/fabric-expectations';
import { geometryOf } from '../../src/fabrics/state/fabric-geometry';
import { fabricNamed, fabrics } from '../../src/shared/fabric/fabric-data';

const HARDLY = 0.05;
const all = fabrics.map((fabric) => geometryOf(fabric).recomputed);
const weightsOf = (name: string) => geometryOf(fabricNamed(name)).recomputed;

/** 1 for the fabric with the least weight on that term. */
const rank = (weights: TermNumbers, term: Term) =>
  1 + all.filter((other) => other[term] < weights[term]).length;

const isTop = (weights: TermNumbers, term: Term) =>
  TERMS.every((other) => weights[other] <= weights[term]);

const unevenness = (weights: TermNumbers) => {
  const shares = TERMS.map((term) => weights[term]);
  return Math.max(...shares) - Math.min(...shares);
};

const isAlmost = (a: TermNumbers, b: TermNumbers) =>
  TERMS.every((term) => Math.abs(a[term] - b[term]) < 0.005);

const most = fabrics.length;

/** Sentences, and the weights of which each is true. */
const CLAIMS: readonly [RegExp, (weights: TermNumbers) => boolean][] = [
  [/weighs recovery most/i, (w) => isTop(w, 'recovery')],
  [/recovery most, then stretch/, (w) => w.stretch > w.bending],
  [/recovery by the largest share of all/, (w) => rank(w, 'recovery') === most],
  [
    /hardly any recovery, the least of all/,
    (w) => w.recovery < HARDLY && rank(w, 'recovery') === 1,
  ],
  [/recovery almost as much/, (w) => w.recovery > 0.75 * w.bending],
  [/recovery far more than stretch and bending/, (w) => w.recovery > 2 * (w.stretch + w.bending)],
  [/recovery more than stretch and bending together/, (w) => w.recovery > w.stretch + w.bending],
  [/and these two evenly/, (w) => Math.abs(w.stretch - w.bending) < 0.02],
  [/recovery and bending evenly/, (w) => Math.abs(w.recovery - w.bending) < 0.005],
  [/shares its weights (rather )?evenly/i, (w) => unevenness(w) < 0.2],
  [/the most so of all/, (w) => all.every((other) => unevenness(w) <= unevenness(other))],
  [/hardly any stretch/, (w) => w.stretch < HARDLY],
  [/weighs stretch more than anything else/i, (w) => isTop(w, 'stretch')],
  [/anything else, and by the largest share of all/, (w) => rank(w, 'stretch') === most],
  [/and stretch more than wool does/, (w) => w.stretch > weightsOf('wool').stretch],
  [/keeps its lengths/, (w) => w.stretch > 0.4],
  [/hardly any (stretch or )?bending/, (w) => w.bending < HARDLY],
  [/bending, the least of all/, (w) => rank(w, 'bending') === 1],
  [/bending by the largest share of all/, (w) => rank(w, 'bending') === most],
  [/weighs bending more than anything else/i, (w) => isTop(w, 'bending')],
  [/nothing to round its folds/, (w) => w.bending < 0.001],
  [/\bround (dome|sweep)|folds stay round/, (w) => w.bending > 0.4],
  [/spike/, (w) => w.stretch < HARDLY && w.bending < HARDLY],
  [/stretches around the handle/, (w) => w.stretch < 0.01],
  [/\bwide\b/, (w) => rank(w, 'recovery') <= 3],
  [/whole sheet/, (w) => w.recovery < 0.001],
  [/middling reach/, (w) => rank(w, 'recovery') >= 6 && rank(w, 'recovery') <= 10],
  [/\bnarrow\b/, (w) => rank(w, 'recovery') > 11],
  [/reaches farther than in wool/, (w) => w.recovery < weightsOf('wool').recovery],
  [/the shape of leather/, (w) => isAlmost(w, weightsOf('leather'))],
  [/the shape of gabardine/, (w) => isAlmost(w, weightsOf('gabardine'))],
];

const TOLD: Record<Term, RegExp> = {
  recovery: /recovery/,
  stretch: /stretch/,
  bending: /bending/,
};

describe('fabric-expectations', () => {
  it('has one sentence for each fabric and no other', () => {
    expect(Object.keys(EXPECTATIONS).sort()).toEqual(fabrics.map((f) => f.name_en).sort());
    for (const sentence of Object.values(EXPECTATIONS)) expect(sentence).toMatch(/^[A-Z][^.]+\.$/);
  });

  it.each(Object.entries(EXPECTATIONS))(
    'says of %s what its weights bear out',
    (name, sentence) => {
      const claimed = CLAIMS.filter(([phrase]) => phrase.test(sentence));
      expect(claimed.length).toBeGreaterThan(1);
      for (const [phrase, holds] of claimed)
        expect(holds(weightsOf(name)), phrase.source).toBe(true);
    },
  );

  it('speaks of shares, not of stiffness, which weights do not tell', () => {
    for (const sentence of Object.values(EXPECTATIONS))
      expect(sentence).not.toMatch(/stiff|resist/i);
  });

  it('tells of every superlative whose it is', () => {
    for (const sentence of Object.values(EXPECTATIONS)) {
      const superlatives = sentence.match(/of all fabrics/g)?.length ?? 0;
      const checked = CLAIMS.filter(([phrase]) => /of all/.test(phrase.source));
      expect(checked.filter(([phrase]) => phrase.test(sentence))).toHaveLength(superlatives);
    }
  });

  it.each(Object.entries(EXPECTATIONS))('leaves out nothing %s hardly does', (name, sentence) => {
    const weights = weightsOf(name);
    for (const term of TERMS) {
      if (weights[term] >= HARDLY) continue;
      expect(sentence).toMatch(/hardly/i);
      expect(sentence).toMatch(TOLD[term]);
    }
  });

  it('uses every claim', () => {
    const text = Object.values(EXPECTATIONS).join('\n');
    for (const [phrase] of CLAIMS) expect(text).toMatch(phrase);
  });
});
