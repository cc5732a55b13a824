// Frames of a mesh in few bytes: places as whole multiples of a quantum, each vertex told from its
// parents in the mesh and from the frames before, then deflated.

export interface RecordingHead {
  format: 'pleat recording 1';
  /** The name of what was recorded. */
  name: string;
  n_vertices: number;
  /** Numbers a vertex: 3 for places, 2 for mean and deviation of curvature. */
  n_components: number;
  /** Rounding of the numbers, in their unit. */
  quantum: number;
  n_frames: number;
  /** Time of the first frame and between frames [s]. */
  first_s: number;
  every_s: number;
  /** Time of a frame on the machine that computed it [ms]; null where nothing was timed. */
  ms_per_frame: number | null;
}

/** Four a vertex, the vertices whose mean it is on a refinement, -1 for none; parents come first. */
export type Parents = Int32Array;

/**
 * Numbers of one frame, as the part that neither parents nor earlier frames tell, and back. What a
 * vertex differs from its parents' mean by changes little from frame to frame; a base vertex goes
 * on as it went.
 */
function createPredictor(head: RecordingHead, parents: Parents) {
  const { n_vertices: nVertices, n_components: nComponents } = head;
  let present = new Int32Array(nVertices * nComponents);
  let before = new Int32Array(nVertices * nComponents);
  let next = new Int32Array(nVertices * nComponents);
  let nFrames = 0;

  /** The prediction of a number; `next` holds those of the vertex's parents already. */
  function foretold(vertex: number, component: number): number {
    const at = vertex * nComponents + component;
    const now = present[at] as number;
    let change = 0;
    let k = 4 * vertex;
    for (const end = k + 4; k < end; ++k) {
      const parent = parents[k] as number;
      if (parent < 0) break;
      const from = parent * nComponents + component;
      change += (next[from] as number) - (present[from] as number);
    }
    const nParents = k - 4 * vertex;
    if (nParents > 0) return now + Math.round(change / nParents);
    return nFrames < 2 ? now : 2 * now - (before[at] as number);
  }

  function turn(): Int32Array {
    nFrames += 1;
    [before, present, next] = [present, next, before];
    return present;
  }

  /** Calls `exchange` with each foretold number in order; it answers with the true one. */
  return (exchange: (foretold: number, at: number) => number): Int32Array => {
    for (let vertex = 0; vertex < nVertices; ++vertex) {
      for (let component = 0; component < nComponents; ++component) {
        const at = vertex * nComponents + component;
        next[at] = exchange(foretold(vertex, component), at);
      }
    }
    return turn();
  };
}

/** The bytes to be deflated. Whole numbers, sign last, seven bits a byte, the lowest first. */
export function encodeFrames(
  head: RecordingHead,
  parents: Parents,
  frames: readonly ArrayLike<number>[],
): Uint8Array {
  const bytes: number[] = [];
  const predict = createPredictor(head, parents);
  for (const frame of frames) {
    predict((foretold, at) => {
      const value = Math.round((frame[at] ?? 0) / head.quantum);
      const rest = value - foretold;
      let code = rest < 0 ? -2 * rest - 1 : 2 * rest;
      for (; code > 127; code = Math.floor(code / 128)) bytes.push((code % 128) + 128);
      bytes.push(code);
      return value;
    });
  }
  return Uint8Array.from(bytes);
}

/** One after the other; null when the bytes are not what the head says. */
export function decodeFrames(
  head: RecordingHead,
  parents: Parents,
  bytes: Uint8Array,
): Float32Array[] | null {
  const frames: Float32Array[] = [];
  const predict = createPredictor(head, parents);
  let place = 0;
  let isCut = false;
  function number(): number {
    let code = 0;
    for (let weight = 1; ; weight *= 128) {
      const byte = bytes[place];
      place += 1;
      if (byte === undefined || weight > 2 ** 28) {
        isCut = true;
        return 0;
      }
      code += (byte % 128) * weight;
      if (byte < 128) break;
    }
    return code % 2 === 0 ? code / 2 : -(code + 1) / 2;
  }
  while (frames.length < head.n_frames && !isCut) {
    const values = predict((foretold) => foretold + number());
    const frame = new Float32Array(values.length);
    for (let at = 0; at < frame.length; ++at) frame[at] = (values[at] as number) * head.quantum;
    frames.push(frame);
  }
  return isCut || place !== bytes.length ? null : frames;
}

/** A line of JSON, then the deflated frames. */
export function splitRecording(file: Uint8Array): { head: RecordingHead; body: Uint8Array } | null {
  const end = file.indexOf(10);
  if (end < 0) return null;
  try {
    const head = JSON.parse(new TextDecoder().decode(file.subarray(0, end))) as RecordingHead;
    return head.format === 'pleat recording 1' ? { head, body: file.subarray(end + 1) } : null;
  } catch {
    return null;
  }
}

async function inflated(body: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([body as Uint8Array<ArrayBuffer>])
    .stream()
    .pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export interface Recording {
  head: RecordingHead;
  frames: Float32Array[];
}

/** A file of a mesh with these parents; null when it is of another one, or damaged. */
export async function readRecording(file: Uint8Array, parents: Parents): Promise<Recording | null> {
  const parts = splitRecording(file);
  if (!parts || parts.head.n_vertices !== parents.length / 4) return null;
  try {
    const frames = decodeFrames(parts.head, parents, await inflated(parts.body));
    return frames && { head: parts.head, frames };
  } catch {
    return null;
  }
}
