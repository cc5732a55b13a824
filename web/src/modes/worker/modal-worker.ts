import { givenCore } from '../../shared/workers/given-core';
import { serve } from '../../shared/workers/serve';
import type { ModalModule } from '../bindings/modal-module';
import { ModalCore } from './modal-core';
import type { FromModal, ToModal } from './modal-protocol';

serve<ToModal, FromModal>(
  self,
  async (post) => new ModalCore(await givenCore<ModalModule>(), post),
);
