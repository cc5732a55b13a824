// A button that copies the link to what is shown, and says what the link does not carry.
import { element, setText } from '../../shared/panels/element';
import { toolButton } from '../../shared/panels/tool-button';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';

/** Sentences on what a link leaves out. */
function losses({ astray, setting, mesh }: MotionState): string[] {
  const parts: string[] = [];
  if (astray === 'pulled') parts.push('The pull is not kept: it shows the cloth as if untouched.');
  if (astray === 'changed')
    parts.push(
      'The change on the way is not kept: it runs with the present setting from the start.',
    );
  if (setting.preset === 'obj' && mesh?.isOwn) parts.push('Your file is not in it.');
  return parts;
}

/** Words on what the copied link does. */
export function linkSentence(state: MotionState): string {
  const time = state.numbers?.time_s ?? 0;
  const shows = time > 0 ? `It runs to ${time.toFixed(2)} s and rests there.` : '';
  return ['Link copied.', shows, ...losses(state)].filter((part) => part !== '').join(' ');
}

export function createLinkTool(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: { rest(): Promise<void>; link(): string },
): void {
  const said = element('p', { class: 'note', role: 'status' });
  async function copy(): Promise<void> {
    await actions.rest();
    const address = new URL(actions.link(), window.location.href).href;
    window.history.replaceState(null, '', address);
    const isCopied = await navigator.clipboard.writeText(address).then(
      () => true,
      () => false,
    );
    const refused = 'The browser refused the copy: the address bar holds the link.';
    setText(said, isCopied ? linkSentence(store.get()) : refused);
  }
  const button = toolButton('link', 'Copy link', 'Copy a link to what is shown', () => void copy());
  parent.append(button.made, said);
  // The words are of what was shown then.
  watch(store, ['setting', 'playing', 'camera', 'phase'], () => setText(said, ''));
}
