// Makes the slider of the time, the play button, and buttons for the exact contact and the
// detector's contact.
import { html } from "../dom";
import { shortTime } from "../words";

const secondsOfStep = 4;

export class TimeControls {
  readonly element: HTMLElement;
  time = 0;
  private readonly slider: HTMLInputElement;
  private readonly readout = html("output", { class: "readout" });
  private readonly playButton = html("button", { type: "button", click: () => this.toggle() }, "Play");
  private readonly exactButton = html("button", { type: "button", class: "stop-exact" });
  private readonly detectorButton = html("button", { type: "button", class: "stop-detector" });
  private readonly ticks = html("div", { class: "ticks", "aria-hidden": "true" });
  private playing: number | null = null;

  constructor(
    private readonly length: number,
    private readonly onChange: () => void,
  ) {
    this.slider = html("input", {
      type: "range",
      min: 0,
      max: length,
      step: 0.001,
      value: 0,
      "aria-label": "Time of the motion",
      input: () => {
        this.pause();
        this.time = Number(this.slider.value);
        this.onChange();
      },
    });
    const start = html("button", { type: "button", click: () => this.jump(0) }, "Start");
    const end = html("button", { type: "button", click: () => this.jump(length) }, "End");
    this.element = html(
      "div",
      { class: "time" },
      html("div", { class: "track" }, this.ticks, this.slider),
      html("div", { class: "buttons" }, this.playButton, start, this.exactButton, this.detectorButton, end, this.readout),
    );
  }

  setStops(exact: number | null, detector: number | null): void {
    this.ticks.replaceChildren();
    this.stop(this.exactButton, "exact", "Exact contact", exact);
    this.stop(this.detectorButton, "detector", "Detector's contact", detector);
  }

  set(time: number): void {
    this.time = Math.min(this.length, Math.max(0, time));
    this.slider.value = String(this.time);
  }

  describe(text: string): void {
    this.readout.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
  }

  pause(): void {
    if (this.playing !== null) cancelAnimationFrame(this.playing);
    this.playing = null;
    this.playButton.textContent = "Play";
  }

  private jump(time: number): void {
    this.pause();
    this.set(time);
    this.onChange();
  }

  private stop(button: HTMLButtonElement, kind: string, name: string, time: number | null): void {
    button.hidden = time === null;
    if (time === null) return;
    const step = Math.min(this.length - 1, Math.floor(time));
    button.textContent = `${name}, t = ${shortTime(time - step)}`;
    button.onclick = () => this.jump(time);
    const tick = html("span", { class: `tick ${kind}` });
    tick.style.left = `${(100 * time) / this.length}%`;
    this.ticks.append(tick);
  }

  private toggle(): void {
    if (this.playing !== null) return this.pause();
    if (this.time >= this.length) this.set(0);
    this.playButton.textContent = "Pause";
    let last = performance.now();
    const tick = (now: number): void => {
      this.set(this.time + (now - last) / 1000 / secondsOfStep);
      last = now;
      this.onChange();
      if (this.time >= this.length) return this.pause();
      this.playing = requestAnimationFrame(tick);
    };
    this.playing = requestAnimationFrame(tick);
  }
}
