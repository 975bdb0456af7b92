// Connects the page to the server: requests and states are JSON, pixels are binary. Only this file knows the format.

const FIRST_WAIT = 250;  // [ms] before the first try to connect again
const LONGEST_WAIT = 4000;

class Connection {
  /**
   * `on` has the callbacks state(object), tile(header, halves), found() and lost(). `base` is the path of the page and
   * contains the token.
   */
  constructor(base, on) {
    this.base = base;
    this.on = on;
    this.sequence = 0;
    this.waiting = new Map();
    this.wait = FIRST_WAIT;
    this.connect();
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.socket = new WebSocket(`${scheme}://${location.host}${this.base}socket`);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => {
      this.wait = FIRST_WAIT;
      this.on.found();
    });
    this.socket.addEventListener("message", (event) => this.receive(event.data));
    this.socket.addEventListener("close", () => this.lose());
  }

  /** Reports that the server is gone, and reconnects with growing delays. */
  lose() {
    for (const { reject } of this.waiting.values()) {
      reject(new Error("the server is gone"));
    }
    this.waiting.clear();
    this.on.lost();
    setTimeout(() => this.connect(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
  }

  receive(data) {
    if (typeof data !== "string") {
      this.receiveTile(data);
      return;
    }
    const message = JSON.parse(data);
    if (message.state) {
      this.on.state(message.state);
    }
    const request = this.waiting.get(message.ack);
    if (request) {
      this.waiting.delete(message.ack);
      if (message.error) {
        request.reject(new Error(message.error));
      } else {
        request.resolve(message);
      }
    }
  }

  receiveTile(buffer) {
    const [version, slot, generation, sequence, gridWidth, gridHeight, x, y, width, height, samples, channels, denoised] =
      new Uint32Array(buffer, 0, 13);
    if (version === 3) {
      this.on.tile({ slot, generation, sequence, grid: { width: gridWidth, height: gridHeight }, tile: { x, y, width, height },
        samples, channels, denoised: denoised === 1 }, new Uint16Array(buffer, 52));
    }
  }

  /** Sends a request; returns a promise of the answer, which rejects with the server's error message. */
  request(what) {
    if (this.socket.readyState !== WebSocket.OPEN) {
      return Promise.reject(new Error("the server is gone"));
    }
    const seq = ++this.sequence;
    this.socket.send(JSON.stringify({ seq, ...what }));
    return new Promise((resolve, reject) => this.waiting.set(seq, { resolve, reject }));
  }

  /** Returns the address of a file that the server generates. */
  address(name, query) {
    return `${this.base}${name}?${new URLSearchParams(query)}`;
  }
}

/** Gives a file to the server as the environment. Throws the server's reason if it is refused. */
async function giveEnvironment(connection, file) {
  const answer = await fetch(connection.address("environment", {}) + `name=${encodeURIComponent(file.name)}`, { method: "PUT", body: file });
  if (!answer.ok) {
    throw new Error((await answer.text()).trim());
  }
}

/** Sends one request at a time; merges those that wait by `join(waiting, more)`. */
class OneAtATime {
  /** `send(what)` returns a promise that settles when the server has accepted the request. */
  constructor(send, join) {
    this.send = send;
    this.join = join;
    this.waiting = null;
    this.onWay = false;
  }

  /** Returns whether a request is in flight or waits. */
  get busy() {
    return this.onWay || this.waiting !== null;
  }

  /** Resolves when the server has accepted all requests. */
  async idle() {
    while (this.busy) {
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  }

  add(more) {
    this.waiting = this.waiting ? this.join(this.waiting, more) : more;
    if (!this.pending && !this.onWay) {
      this.pending = requestAnimationFrame(() => this.flush());
    }
  }

  /** Drops what is not sent yet. */
  drop() {
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    this.waiting = null;
  }

  flush() {
    const what = this.waiting;
    this.pending = 0;
    this.waiting = null;
    this.onWay = true;
    this.send(what).catch(() => {}).finally(() => {
      this.onWay = false;
      if (this.waiting && !this.pending) {
        this.pending = requestAnimationFrame(() => this.flush());
      }
    });
  }
}
