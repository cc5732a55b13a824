// A count of the method: a field, and a slider that tells where it is dragged to.
import { element, field } from '../../../shared/panels/element';
import { type Count, numberOf, stepperRow } from '../../../shared/steppers/steppers';
import { MOST_ITERATIONS, MOST_SUBSTEPS, type Setting, sliderCounts } from '../../state/setting';

const COUNT_TITLES: Record<Count, { title: string; most: number }> = {
  substeps: { title: 'Substeps', most: MOST_SUBSTEPS },
  iterations: { title: 'Iterations', most: MOST_ITERATIONS },
};

interface CountActions {
  /** Heard while the slider is dragged. */
  drag(value: number): void;
  choose(value: number): void;
}

/** A slider for a whole number; `show` takes the least that it may be. */
function countSlider(title: string, { drag, choose }: CountActions) {
  let counts: number[] = [];
  const value = (): number => counts[input.valueAsNumber] ?? 1;
  const tell = () => input.setAttribute('aria-valuetext', `${value()}`);
  const input = element('input', {
    type: 'range',
    min: 0,
    'aria-label': `${title}, slider`,
    input() {
      tell();
      drag(value());
    },
    change: () => choose(value()),
  });
  return {
    input,
    show(shown: number, least: number) {
      counts = sliderCounts(least);
      input.max = String(counts.length - 1);
      input.value = String(counts.filter((count) => count <= shown).length - 1);
      tell();
    },
  };
}

/** A whole number that is there only for the steppers that listen to it. */
export function countField(count: Count, actions: CountActions) {
  const { title, most } = COUNT_TITLES[count];
  const slider = countSlider(title, {
    drag(value) {
      input.value = String(value);
      actions.drag(value);
    },
    choose: actions.choose,
  });
  const input = element('input', {
    type: 'number',
    max: most,
    step: 1,
    inputmode: 'numeric',
    change() {
      const value = Math.round(Number(input.value));
      const chosen = Math.min(most, Math.max(Number(input.min), value || 0));
      input.value = String(chosen);
      actions.choose(chosen);
    },
  });
  const box = field(title, input, slider.input);
  box.classList.add('count-field');
  return {
    box,
    show(setting: Setting) {
      const trait = stepperRow(setting.stepper).settings[count];
      box.hidden = !trait;
      if (!trait) return;
      const least = numberOf(trait.least);
      input.min = String(least);
      input.value = String(setting[count]);
      slider.show(setting[count], least);
      box.title = trait.meaning;
    },
  };
}
