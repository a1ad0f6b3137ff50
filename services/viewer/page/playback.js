// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Pauses, steps and speeds up the replays of the deployment; what they say of it comes with their heartbeats.

const valueOf = (status, name) => status.diagnostics.find((each) => each.name === name)?.value ?? '';

export class PlaybackBar {
  // `ask`: sends a request to all replays.
  constructor(parts, ask) {
    Object.assign(this, parts); // bar, pause, step, speed, where
    this.paused = false;
    this.asked = 0; // [ms] when a wish was sent: until the next heartbeats it counts
    const wish = (request) => { this.asked = performance.now(); ask(request); };
    this.pause.onclick = () => { this.setPaused(!this.paused); wish({ paused: this.paused }); };
    this.step.onclick = () => { this.setPaused(true); wish({ step: 1 }); };
    this.speed.onchange = () => wish({ speed: Number(this.speed.value) });
  }

  setPaused(paused) {
    this.paused = paused;
    this.pause.textContent = paused ? 'Resume' : 'Pause';
    this.pause.setAttribute('aria-pressed', String(paused));
  }

  // Whether nothing comes because of it.
  holds() { return this.paused && !this.bar.hidden; }

  // `services`: newest heartbeats by label. `offered`: the server passes wishes on.
  update(services, offered) {
    const replays = [...services.values()].map(({ status }) => status).filter((status) => status.kind === 'replay' && valueOf(status, 'Playback'));
    this.bar.hidden = !offered || replays.length === 0;
    if (this.bar.hidden) return;
    const done = replays.every((status) => status.state !== 'STATE_ACTIVE');
    for (const control of [this.pause, this.step, this.speed]) control.disabled = done;
    const [first] = replays;
    const playback = valueOf(first, 'Playback');
    if (performance.now() - this.asked > 2500) {
      this.setPaused(playback === 'paused');
      const speed = playback === 'without waiting' ? '0' : playback.replace(' x', '');
      if (playback !== 'paused' && [...this.speed.options].some((option) => option.value === speed)) this.speed.value = speed;
    }
    const text = [done ? 'ended' : '', valueOf(first, 'Recorded Time'), valueOf(first, 'Progress')].filter(Boolean).join(' · ');
    if (this.where.textContent !== text) this.where.textContent = text;
  }
}
