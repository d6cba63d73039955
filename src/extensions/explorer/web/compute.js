/*
 * The workers: one follows the orbits on the screen, another does what may take seconds, and a pool
 * of one for each processor computes many orbits, so that none waits for another.
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
    const id = (Computer.count = (Computer.count ?? 0) + 1);
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

/** Workers that share requests, which are done in their order. */
class Pool {
  constructor() {
    this.workers = navigator.hardwareConcurrency || 2;
    this.idle = Array.from({ length: this.workers }, () => new Computer());
    this.queue = [];
  }

  /** Ask for a job unless `wanted` is false when its turn comes; the promise then holds null. */
  ask(job, args, wanted = () => true) {
    return new Promise((resolve, reject) => {
      this.queue.push({ job, args, wanted, resolve, reject });
      this.next();
    });
  }

  async next() {
    while (this.queue.length && !this.queue[0].wanted()) this.queue.shift().resolve(null);
    if (!this.queue.length || !this.idle.length) return;
    const computer = this.idle.pop();
    const { job, args, wanted, resolve, reject } = this.queue.shift();
    try {
      const result = await computer.ask(job, args);
      resolve(wanted() ? result : null);
    } catch (error) {
      reject(error);
    }
    this.idle.push(computer);
    this.next();
  }
}
