/** Palpate: a finger on a soft human body or on any mesh, as WebAssembly. Lengths in mm, forces in N; a tick is a millisecond. */

export type Vector = [number, number, number];
/** One of two fingertips of 8 mm radius. */
export type FingerIndex = 0 | 1;

/** A place of a body with a name: "T6", "left PSIS". */
export interface Place {
  name: string;
  /** On the skin at rest. x to the patient's right seen from behind, y to the head, z out of the back. */
  at: Vector;
  /** Out of the skin, of length 1. */
  normal: Vector;
}

/** Where a finger is wanted. The tip goes there as a hand would, so a press takes some tenths of a second. */
export interface Aim {
  /** On the skin at rest. Default: the origin. */
  place?: Vector | number[];
  /** Out of the skin. Default: [0, 0, 1]. */
  normal?: Vector | number[];
  /** Under the skin when pressed. Default: 0. */
  depth?: number;
  /** False: the finger hovers. Default: false. */
  pressed?: boolean;
}

/** What a finger felt in the last tick. */
export interface Felt {
  tip: Vector;
  /** Where the fingertip is held by the surface. */
  proxy: Vector;
  normal: Vector;
  /** On the hand, N. */
  force: Vector;
  /** How far the tip is under the surface, mm. */
  depth: number;
  /** 0 free, 1 sticks, 2 slips. */
  touch: 0 | 1 | 2;
  /** Bits; 0 when all is well. */
  status: number;
}

/** The skin, or the parts of it that changed. */
export interface Frame {
  /** First vertex and end of each range, in turn. */
  ranges: Uint32Array;
  /** Seven numbers a vertex of the ranges: position (mm), normal, strain. */
  values: Float32Array;
}

export interface Body {
  name: string;
  closed: boolean;
  /** What was mended of a mesh. */
  notes: string[];
  landmarks: Place[];
  /** Seven numbers a vertex, as Frame.values. */
  rest: Float32Array;
  /** Three vertices a triangle. */
  corners: Uint32Array;
  /** N/mm, one a vertex. */
  stiffness: Float32Array;
  /** All bones as one mesh, or null where there are none. */
  bones: { positions: Float32Array; corners: Uint32Array } | null;
  /** Colour scales of 256 x RGBA. */
  colours: { stiffness: Uint8Array; strain: Uint8Array };
}

/** A place that is stiffer or softer than around it. */
export interface Dysfunction {
  x: number;
  y: number;
  /** mm */
  radius: number;
  /** Per cent of stiffness: 60 is stiffer by 60 %. */
  change: number;
}

/** One body under two fingers. Nothing runs by itself: `run` is time. Methods throw an Error in one line. */
export declare class Palpate {
  private constructor();
  /** Opens the trunk that comes with the package, 28,000 triangles of skin over its bones. */
  openTrunk(): Promise<Body>;
  /**
   * Opens a mesh: STL, OBJ, PLY, OFF, glTF or GLB, by the ending of its name; at most 2,000,000 triangles.
   * @param unit_mm millimetres of its unit; 0: as the format says (glTF metres, others millimetres)
   */
  openMesh(bytes: Uint8Array, name: string, unit_mm: number): void;
  /** What can be drawn and named of the open body. */
  body(): Body;
  /** A place of the open body by its spoken name. Throws for an unknown one. */
  place(name: string): Place;
  /** Replaces the dysfunctions of the body. */
  setDysfunctions(list: Dysfunction[]): void;
  /** The three lumps of the preset "lumps" under the skin of the trunk, or none. */
  setLumps(on: boolean): void;
  /** N/mm, one a vertex. */
  stiffness(): Float32Array;
  /** Says where a finger is wanted from now on; null lifts it. */
  aim(finger: FingerIndex, aim: Aim | null): void;
  /** Lets so many milliseconds pass. */
  run(ticks: number): void;
  felt(finger: FingerIndex): Felt;
  /** Pressures on a fingertip, kPa, as taxels x taxels, the first row nearest to the head; null on a body without lumps. */
  pad(finger: FingerIndex, taxels: number): number[] | null;
  /** The skin as the fingers leave it: what changed since the last call, or all of it. */
  frame(all?: boolean): Frame;
  /** What was felt so far and on what: forces.csv and scene.toml, which the command `palpate` reads. */
  record(): { csv: string; toml: string };
}

/** Loads the engine. Each call gives one of its own, with its own memory. */
export declare function load(): Promise<Palpate>;
