// A file dropped anywhere on the page.

function hasFile(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes('Files') ?? false;
}

export function createDropTarget(
  target: HTMLElement,
  actions: { openObj(file: File): void },
): void {
  const show = (isDropping: boolean) => target.classList.toggle('dropping', isDropping);
  target.addEventListener('dragover', (event) => {
    if (!hasFile(event)) return;
    event.preventDefault(); // or the browser would open the file itself
    show(true);
  });
  target.addEventListener('dragleave', (event) => show(event.relatedTarget !== null));
  target.addEventListener('drop', (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    show(false);
    const [file] = event.dataTransfer?.files ?? [];
    if (file) actions.openObj(file);
  });
}
