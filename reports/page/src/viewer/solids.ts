// The moving parts of the 3D picture: triangles, edges, the pair, ghosts, the view primitive.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Point } from "../report";
import type { Motion } from "./motion";
import { pairSets, type Palette } from "./palette";

type Triangle = [number, number, number];

const outline = (triangles: Triangle[], places: Point[]): number[] =>
  triangles.flatMap(([a, b, c]) => [a, b, b, c, c, a].flatMap((v) => places[v]!));

export class Solids {
  readonly group = new Group();
  private readonly faces: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly pairLines = fatLines(3.5);
  private readonly primitiveLines = fatLines(4);
  private readonly ghostFaces = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ transparent: true, opacity: 0.14, side: DoubleSide, depthWrite: false }),
  );
  private readonly ghostEdges = new LineSegments(
    new BufferGeometry(),
    new LineDashedMaterial({ dashSize: 0.03, gapSize: 0.025 }),
  );

  constructor(
    private readonly motion: Motion,
    private palette: Palette,
  ) {
    this.faces = new Mesh(
      new BufferGeometry(),
      new MeshLambertMaterial({
        vertexColors: true,
        flatShading: true,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      }),
    );
    this.edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
    this.group.add(this.faces, this.edges, this.ghostFaces, this.ghostEdges);
    this.group.add(this.pairLines, this.primitiveLines);
    for (const child of this.group.children) child.frustumCulled = false;
    // These lines are drawn over see-through faces.
    this.pairLines.renderOrder = this.primitiveLines.renderOrder = 1;
    this.recolour(palette);
  }

  recolour(palette: Palette): void {
    this.palette = palette;
    this.edges.material.color = palette.of("--edge");
    this.pairLines.material.color = palette.of("--pair");
    this.primitiveLines.material.color = palette.of("--primitive");
    this.ghostFaces.material.color = palette.of("--ghost");
    this.ghostEdges.material.color = palette.of("--ghost");
  }

  seeThrough(on: boolean): void {
    const material = this.faces.material;
    material.transparent = on;
    material.opacity = on ? 0.7 : 1;
    material.depthWrite = !on;
    material.needsUpdate = true;
  }

  show(time: number, pair: [number, number] | null, ghosts: boolean, primitive: boolean): void {
    const { step, t } = this.motion.at(time);
    const places = this.motion.places(time);
    const triangles = this.motion.scene.triangles;
    set(this.faces.geometry, triangles.flatMap((f) => f.flatMap((v) => places[v]!)));
    const colours = triangles.flatMap((_, i) => {
      const ofPair = pairSets[pair?.indexOf(i) ?? -1] ?? "none";
      const colour = this.palette.set(step.views ? (step.views.sets[i] ?? "none") : ofPair);
      return [...colour.toArray(), ...colour.toArray(), ...colour.toArray()];
    });
    this.faces.geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
    set(this.edges.geometry, outline(triangles, places));

    const shown = (pair ?? []).map((i) => triangles[i]).filter((f) => f !== undefined);
    setFat(this.pairLines, outline(shown, places));

    const fans = ghosts ? (step.views?.ghosts ?? []) : [];
    set(this.ghostFaces.geometry, fans.flatMap((f) => f.flatMap((v) => places[v]!)));
    set(this.ghostEdges.geometry, outline(fans, places));
    this.ghostEdges.computeLineDistances();

    const segments = primitive ? (step.views?.primitives ?? []) : [];
    setFat(
      this.primitiveLines,
      segments.flatMap((p) =>
        p.q1 ? [...this.motion.moving(p.q0, t), ...this.motion.moving(p.q1, t)] : [],
      ),
    );
  }
}

function set(geometry: BufferGeometry, numbers: number[]): void {
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
  geometry.computeBoundingSphere();
}

function fatLines(linewidth: number): LineSegments2 {
  return new LineSegments2(
    new LineSegmentsGeometry(),
    new LineMaterial({ linewidth, depthTest: false, transparent: true, opacity: 0.95 }),
  );
}

function setFat(lines: LineSegments2, numbers: number[]): void {
  lines.visible = numbers.length > 0;
  if (!lines.visible) return;
  lines.geometry.dispose();
  lines.geometry = new LineSegmentsGeometry();
  lines.geometry.setPositions(numbers);
}
