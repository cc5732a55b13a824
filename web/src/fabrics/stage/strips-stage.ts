// Strips of cloth over the edges of shelves, side by side in one picture. It gets frames and an order, and
// tells where the name of each strip belongs.
import { Box3, BoxGeometry, Group, Mesh, MeshStandardMaterial, Sphere, Vector3 } from 'three';
import type { Triple } from '../../shared/bindings/geometry';
import { lookOf } from '../../shared/fabric/fabric-look';
import { uprightOf } from '../../shared/stage/camera-control';
import { type ClothMesh, createClothMesh } from '../../shared/stage/cloth-mesh';
import { createPaneStage, type PaneStage } from '../../shared/stage/pane-stage';
import { tipOf } from '../state/strips';

/** Sizes of what is shown [m]: a strip, lying and hanging along z, whose edge lies at its origin. */
export interface StripSizes {
  width: number;
  lying: number;
  hanging: number;
}

export interface StripsStageEvents {
  /** Gets where the names belong in this picture, in pixels from the canvas's upper left corner. */
  drawn(places: readonly { x: number; y: number }[]): void;
  key(name: string): boolean;
  pictureLost(isLost: boolean): void;
}

export interface StripMesh {
  triangles: Uint32Array;
  nVertices: number;
  buffer: ArrayBuffer;
}

/** The view from far away, a little from the right and above: strips farther off look as large as near ones. */
const FOV = 12;
const AZIMUTH = 0.42;
const POLAR = 1.3;

/** Room for one strip across, in its widths. */
const PITCH = 1.5;

/** Room below a strip for its name, in lengths that hang. */
const NAME_ROOM = 0.36;

/** Height over the uppermost edge that is seen, and room between a strip's end and its name, likewise. */
const ROOM_ABOVE = 0.12;
const NAME_BELOW = 0.05;

/** Room on both sides, in half of what is seen across. */
const MARGIN = 1.05;

/** Thickness of a shelf, in lengths that hang; and a hair of room between it and the cloth. */
const SHELF = 0.1;
const CLEARANCE = 0.006;

/** Places of the strips: on shelves, one below the other, so many to a shelf. */
class Shelves {
  readonly object = new Group();
  readonly wood = new MeshStandardMaterial({ roughness: 0.8 });
  private nStrips = 0;
  private perRow = 1;
  private readonly pitch: number;
  private readonly rowHeight: number;

  constructor(private readonly sizes: StripSizes) {
    this.pitch = PITCH * sizes.width;
    this.rowHeight = sizes.hanging * (1 + SHELF + NAME_ROOM);
  }

  /** True when that is another arrangement. */
  set(nStrips: number, perRow: number): boolean {
    if (nStrips === this.nStrips && perRow === this.perRow) return false;
    this.nStrips = nStrips;
    this.perRow = perRow;
    this.build();
    return true;
  }

  /** The edge under the middle of a strip, by its place in the order [m]. */
  edgeOf(index: number): Triple {
    const row = Math.floor(index / this.perRow);
    const nInRow = Math.min(this.perRow, this.nStrips - row * this.perRow);
    const across = (index % this.perRow) - (nInRow - 1) / 2;
    return [across * this.pitch, -row * this.rowHeight, 0];
  }

  /** Ends of the box that has to be seen [m]. */
  box(): { low: Triple; high: Triple } {
    const { lying, hanging } = this.sizes;
    const nRows = Math.ceil(this.nStrips / this.perRow);
    const half = (Math.min(this.nStrips, this.perRow) * this.pitch) / 2;
    const bottom = -(nRows - 1) * this.rowHeight - hanging * (1 + NAME_ROOM);
    return { low: [-half, bottom, -lying], high: [half, ROOM_ABOVE * hanging, hanging] };
  }

  private build(): void {
    for (const shelf of this.object.children) (shelf as Mesh).geometry.dispose();
    this.object.clear();
    const { lying, hanging } = this.sizes;
    const [depth, height] = [1.2 * lying, SHELF * hanging];
    for (let first = 0; first < this.nStrips; first += this.perRow) {
      const n = Math.min(this.perRow, this.nStrips - first);
      const shelf = new Mesh(new BoxGeometry(n * this.pitch, height, depth), this.wood);
      const top = this.edgeOf(first)[1] - CLEARANCE * hanging;
      shelf.position.set(0, top - height / 2, -depth / 2);
      this.object.add(shelf);
    }
  }
}

/** Strips by their names. */
class Strips {
  readonly object = new Group();
  private readonly clothes = new Map<string, ClothMesh>();

  /** Gives a name its strip, in that fabric. */
  add(name: string, fabricId: number, { triangles, nVertices, buffer }: StripMesh): void {
    const cloth = this.clothes.get(name) ?? createClothMesh();
    this.clothes.set(name, cloth);
    this.object.add(cloth.object);
    cloth.setLook(lookOf(fabricId));
    cloth.setTopology(triangles, nVertices);
    cloth.setFrame(buffer, 'stretch');
  }

  of(name: string): ClothMesh | undefined {
    return this.clothes.get(name);
  }

  update(): void {
    for (const cloth of this.clothes.values()) cloth.update();
  }
}

/** Sets the view so that a box just fits across, or from top to bottom. */
function frame(
  { surroundings, control }: PaneStage,
  { low, high }: ReturnType<Shelves['box']>,
): void {
  const box = new Box3(new Vector3(...low), new Vector3(...high));
  const ball = box.getBoundingSphere(new Sphere());
  const { center: centre } = ball;
  const corners = [low, high].flatMap(([x]) =>
    [low, high].flatMap(([, y]) => [low, high].map(([, , z]) => new Vector3(x, y, z))),
  );
  const right = new Vector3(Math.cos(AZIMUTH), 0, -Math.sin(AZIMUTH));
  const across = corners.map((corner) => Math.abs(corner.clone().sub(centre).dot(right)));
  const radius = MARGIN * Math.max(...across);
  const view = { centre, radius: ball.radius, azimuth: AZIMUTH, polar: POLAR };
  const places = corners.flatMap((corner) => corner.toArray());
  const upright = (uprightOf(places, view, FOV) * ball.radius) / radius;
  surroundings.frame(centre, ball.radius, low[1]);
  control.frame({ ...view, radius, upright });
}

/** Draws into `canvas`, which fills `parent`. Throws when the browser has no WebGL 2. */
export function createStripsStage(
  parent: HTMLElement,
  canvas: HTMLCanvasElement,
  sizes: StripSizes,
  events: StripsStageEvents,
) {
  const strips = new Strips();
  const shelves = new Shelves(sizes);
  let order: readonly string[] = [];

  /** Pixels from the canvas's upper left corner to where a strip's name belongs: under its end. */
  function namePlace(name: string, index: number): { x: number; y: number } {
    const [x, y] = shelves.edgeOf(index);
    const places = strips.of(name)?.positions() ?? [];
    const [, height, out] = places.length > 0 ? tipOf(places) : [0, 0, sizes.hanging];
    const below = NAME_BELOW * sizes.hanging;
    const place = new Vector3(x, y + height - below, out).project(stage.camera);
    return {
      x: ((place.x + 1) / 2) * canvas.clientWidth,
      y: ((1 - place.y) / 2) * canvas.clientHeight,
    };
  }

  const stage = createPaneStage(parent, canvas, {
    fov: FOV,
    objects: [strips.object, shelves.object],
    isReady: () => order.length > 0,
    prepare: () => strips.update(),
    drawn: () => events.drawn(order.map(namePlace)),
    themed: (colour) => shelves.wood.color.set(colour('--stage-body')),
    key: events.key,
    pictureLost: events.pictureLost,
  });
  stage.grid.set(1, 1);
  stage.surroundings.setShadows(false); // one shelf's would fall on the strips of the next
  stage.open();

  function place(): void {
    order.forEach((name, index) => {
      strips.of(name)?.object.position.set(...shelves.edgeOf(index));
    });
    stage.redraw();
  }

  return {
    /** All strips that there will be, in their order, so many to a shelf. */
    arrange(names: readonly string[], perShelf: number) {
      order = names;
      if (shelves.set(names.length, perShelf)) frame(stage, shelves.box());
      place();
    },
    showStrip(name: string, fabricId: number, mesh: StripMesh) {
      strips.add(name, fabricId, mesh);
      place();
    },
    showFrame(name: string, buffer: ArrayBuffer) {
      strips.of(name)?.setFrame(buffer, 'stretch');
      stage.redraw();
    },
    positions: (name: string) => strips.of(name)?.positions() ?? new Float32Array(0),
    homeView: stage.control.home,
    /** The canvas has another shape. */
    refit() {
      stage.refit();
      stage.redraw();
    },
  };
}

export type StripsStage = ReturnType<typeof createStripsStage>;
