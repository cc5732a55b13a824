// A file dropped anywhere on the page.

function hasFile(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes('Files') ?? false;
}

/** Takes files while the view is shown. */
export function createDropTarget(isShown: () => boolean, open: (file: File) => void): void {
  const target = document.body;
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
    if (file && isShown()) open(file);
  });
}
