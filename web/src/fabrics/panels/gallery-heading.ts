// Words above the shapes of all fabrics: what they compare, and what they do not.
import { element } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { DeformState } from '../state/deform-state';

export function createGalleryHeading(store: Store<DeformState>): HTMLElement {
  const heading = element(
    'p',
    { class: 'gallery-heading' },
    element('b', {}, 'What gives way first in each fabric: '),
    'shapes of least energy, by weights that were measured in 2015. They do not rank stiffness; the strips over an edge do.',
  );
  watch(store, ['gallery'], ({ gallery }) => {
    heading.hidden = !gallery;
  });
  return heading;
}
