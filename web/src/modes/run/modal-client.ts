// Starts the worker that finds modes and in-betweens.
import type { Asked, Listener } from '../../shared/workers/asked';
import { startAsked, WHOLE } from '../../shared/workers/compiled-core';
import type { ModalAnswers, ToModal } from '../worker/modal-protocol';

export type ModalClient = Asked<ToModal, ModalAnswers>;
export type StartModal = (listener: Listener<never>) => ModalClient;

export function startModalWorker(listener: Listener<never>): ModalClient {
  return startAsked(
    new Worker(new URL('../worker/modal-worker.ts', import.meta.url), { type: 'module' }),
    listener,
    WHOLE,
  );
}
