declare module '*/modal.mjs' {
  import type { ModalModule } from './modal-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createModal: (options?: { wasmBinary?: Uint8Array }) => Promise<ModalModule>;
  export default createModal;
}
