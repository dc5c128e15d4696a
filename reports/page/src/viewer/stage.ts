// Has the camera, the light and the canvas. Draws only when asked to draw.
import {
  AmbientLight,
  DirectionalLight,
  PerspectiveCamera,
  Scene as ThreeScene,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Point } from "../report";

const distance = 2.15;

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new ThreeScene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly controls: OrbitControls;

  // Throws if there is no WebGL.
  constructor(
    private readonly canvas: HTMLCanvasElement,
    content: Object3D,
    private readonly afterDrawing: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.camera.up.set(0, 0, 1);
    const light = new DirectionalLight(0xffffff, 1.6);
    light.position.set(0.4, 0.7, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1.5), content);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement!);
  }

  // Zooming in then moves the camera towards `at`.
  lookFrom(direction: Point, at: Point): void {
    const target = this.controls.target.set(...at);
    this.camera.position.set(...direction).setLength(distance * (1 + target.length())).add(target);
    this.controls.update();
    this.draw();
  }

  // Turns the camera by radians about the vertical and about the horizontal axis, and multiplies
  // its distance by `closer`.
  turn(around: number, over: number, closer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const polar = Math.acos(offset.z / offset.length());
    const next = Math.min(Math.PI - 0.01, Math.max(0.01, polar + over));
    const side = Math.atan2(offset.y, offset.x) + around;
    offset.setLength(offset.length() * closer);
    const r = offset.length();
    offset.set(r * Math.sin(next) * Math.cos(side), r * Math.sin(next) * Math.sin(side), r * Math.cos(next));
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  // Returns the point in pixels from the upper left corner; null if it is behind the camera.
  project(p: Point): { x: number; y: number } | null {
    const v = new Vector3(...p).project(this.camera);
    if (v.z > 1) return null;
    return { x: ((v.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - v.y) / 2) * this.canvas.clientHeight };
  }

  draw(): void {
    this.renderer.render(this.scene, this.camera);
    this.afterDrawing();
  }

  close(): void {
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement!;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // The whole width is visible in a narrow window too.
    this.camera.zoom = Math.min(1, width / height);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
