// The one connection to the server: requests and states as JSON, pixels in binary. This file alone knows their format.

const FIRST_WAIT = 250;  // [ms] before the first try to connect again
const LONGEST_WAIT = 4000;

class Connection {
  /** `on`: state(object), tile(header, halves), found(), lost(). `base`: the path of the page, which has the token in it. */
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

  /** Tells that the server is gone, and tries again, ever more rarely. */
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
    const [version, slot, generation, sequence, gridWidth, gridHeight, x, y, width, height, samples, channels] =
      new Uint32Array(buffer, 0, 12);
    if (version === 2) {
      this.on.tile({ slot, generation, sequence, grid: { width: gridWidth, height: gridHeight }, tile: { x, y, width, height },
        samples, channels }, new Uint16Array(buffer, 48));
    }
  }

  /** Sends a request; gives a promise of the answer, which fails with the message of the server. */
  request(what) {
    if (this.socket.readyState !== WebSocket.OPEN) {
      return Promise.reject(new Error("the server is gone"));
    }
    const seq = ++this.sequence;
    this.socket.send(JSON.stringify({ seq, ...what }));
    return new Promise((resolve, reject) => this.waiting.set(seq, { resolve, reject }));
  }

  /** The address of a file that the server makes. */
  address(name, query) {
    return `${this.base}${name}?${new URLSearchParams(query)}`;
  }
}

/** Sends what is asked for one at a time; what comes meanwhile is joined to one request by `join(waiting, more)`. */
class OneAtATime {
  /** `send(what)` gives a promise that ends when the server has taken it. */
  constructor(send, join) {
    this.send = send;
    this.join = join;
    this.waiting = null;
    this.onWay = false;
  }

  /** Something was not taken yet. */
  get busy() {
    return this.onWay || this.waiting !== null;
  }

  /** A promise that ends when all is taken. */
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
