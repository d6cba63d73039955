"use strict";
/*
 * The two workers: one follows the orbits on the screen, the other does what may take seconds, so
 * that neither waits for the other and the page waits for none.
 */
class Computer {
  constructor() {
    const source = ["kernel", "worker"].map((id) => document.getElementById(id).textContent + "\n");
    this.source = URL.createObjectURL(new Blob(source, { type: "text/javascript" }));
    this.start();
  }

  start() {
    this.waiting = new Map();
    this.worker = new Worker(this.source);
    this.worker.onmessage = ({ data }) => {
      const { id, result, error } = data;
      const request = this.waiting.get(id);
      if (!request) return;
      this.waiting.delete(id);
      if (error) request.reject(new Error(error));
      else request.resolve(result);
    };
  }

  /** Ask for a job; the promise holds its result. */
  ask(job, args) {
    Computer.count = (Computer.count ?? 0) + 1;
    const id = Computer.count;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, job, ...args });
    });
  }

  /** Give up all jobs; their promises are never settled. */
  restart() {
    if (!this.waiting.size) return;
    this.worker.terminate();
    this.start();
  }
}
