// A way of looking at fabrics: one picture with a panel of its own.
import type { View } from '../shared/page/view';

export interface Way extends View {
  probe: {
    state(): object;
    positions(pane?: number): number[];
    project?(vertex: number, pane?: number): { x: number; y: number } | undefined;
    inviting?(): number;
  };
}
