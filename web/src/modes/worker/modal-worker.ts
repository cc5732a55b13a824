import { serve } from '../../shared/workers/serve';
import createModal from '../../wasm/modal.mjs';
import { ModalCore } from './modal-core';
import type { FromModal, ToModal } from './modal-protocol';

serve<ToModal, FromModal>(self, async (post) => new ModalCore(await createModal(), post));
