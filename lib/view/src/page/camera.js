// Moves the camera by pointer, wheel and keys. Moves made while a request is in flight are summed into one.

/** The camera turns by TURN_ACROSS [rad] for a drag across the picture, and by TURN_KEY [rad] for a key press. */
const TURN_ACROSS = Math.PI;
const TURN_KEY = Math.PI / 36;
const PAN_KEY = 0.05;
const DOLLY_KEY = 1.1;

/** Sends camera moves; sums those that wait for an earlier request. */
class Moves {
  constructor(send) {
    this.queue = new OneAtATime(send, (a, b) => ({ orbit: sum(a.orbit, b.orbit), pan: sum(a.pan, b.pan), dolly: a.dolly * b.dolly }));
  }

  /** Orbits to the right and down [rad]. */
  turn(dx, dy) {
    this.queue.add({ orbit: [dx, dy], pan: [0, 0], dolly: 1 });
  }

  /** Pans to the right and down, in heights of the picture. */
  shift(dx, dy) {
    this.queue.add({ orbit: [0, 0], pan: [dx, dy], dolly: 1 });
  }

  /** Multiplies the distance to the target. */
  approach(factor) {
    this.queue.add({ orbit: [0, 0], pan: [0, 0], dolly: factor });
  }

  /** Drops moves that are not sent yet. */
  drop() {
    this.queue.drop();
  }
}

function sum(a, b) {
  return [a[0] + b[0], a[1] + b[1]];
}

/**
 * Binds drags, the wheel and double clicks on the stage. Clicks without a drag call `click(pixel)`, with the Shift key
 * `sharpen(pixel)`, double clicks `focus(pixel)`.
 */
function bindPointer(stage, moves, { click, sharpen, focus }) {
  const canvas = stage.canvas;
  const nearby = 4;  // [CSS pixels] a press that moves less far is a click
  let drag = null;
  canvas.addEventListener("pointerdown", (event) => {
    drag = { x: event.clientX, y: event.clientY, far: false, pans: event.button === 1 || event.button === 2 || event.shiftKey };
    canvas.setPointerCapture(event.pointerId);
    if (event.button === 1) {
      event.preventDefault();
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!drag || !event.buttons) {
      return;
    }
    const dx = event.clientX - drag.x;
    const dy = event.clientY - drag.y;
    if (!drag.far && Math.hypot(dx, dy) < nearby) {
      return;
    }
    Object.assign(drag, { x: event.clientX, y: event.clientY, far: true });
    canvas.classList.add("dragged");
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (drag.pans) {
      moves.shift(dx / height, dy / height);
    } else {
      moves.turn(TURN_ACROSS * dx / width, TURN_ACROSS * dy / width);
    }
  });
  canvas.addEventListener("pointerup", (event) => {
    canvas.classList.remove("dragged");
    const pixel = drag && !drag.far && event.button === 0 ? stage.pixel(event) : null;
    drag = null;
    if (pixel) {
      (event.shiftKey ? sharpen : click)(pixel);
    }
  });
  canvas.addEventListener("pointercancel", () => {
    canvas.classList.remove("dragged");
    drag = null;
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", (event) => {
    const pixel = stage.pixel(event);
    if (pixel) {
      focus(pixel);
    }
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (event.ctrlKey || event.metaKey) {
      stage.zoomByWheel(event);
      stage.requestDraw();
    } else {
      const lines = event.deltaMode === 1 ? 16 : 1;
      moves.approach(2 ** (lines * event.deltaY / 480));
    }
  }, { passive: false });
}

/** Moves the camera if the key is bound to a move; returns whether it is. */
function moveByKey(event, moves) {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const arrow = arrows[event.key];
  if (arrow && event.shiftKey) {
    moves.shift(PAN_KEY * arrow[0], PAN_KEY * arrow[1]);
  } else if (arrow) {
    moves.turn(TURN_KEY * arrow[0], TURN_KEY * arrow[1]);
  } else if (event.key === "PageUp") {
    moves.approach(1 / DOLLY_KEY);
  } else if (event.key === "PageDown") {
    moves.approach(DOLLY_KEY);
  } else {
    return false;
  }
  return true;
}
