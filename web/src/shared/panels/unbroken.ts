// Sentences in which no line ends between a number and its unit.

const BEFORE_A_UNIT = /(?<=\d) (?=%|(?:[cmµ]?m|m?s|kg|N)\b)/g;

export function unbroken(sentence: string): string {
  return sentence.replace(BEFORE_A_UNIT, '\u00a0');
}
