import assert from "node:assert/strict";
import { test } from "node:test";
import { throttle, type Timers } from "./throttle.ts";

class FakeTimers implements Timers {
  private time = 0;
  private calls: { at: number; call: () => void }[] = [];
  now() {
    return this.time;
  }
  later(milliseconds: number, call: () => void) {
    this.calls.push({ at: this.time + milliseconds, call });
  }
  advance(milliseconds: number) {
    this.time += milliseconds;
    const due = this.calls.filter(({ at }) => at <= this.time);
    this.calls = this.calls.filter(({ at }) => at > this.time);
    for (const { call } of due) call();
  }
}

test("the first value goes at once, the last one certainly, none in between too early", () => {
  const timers = new FakeTimers();
  const sent: number[] = [];
  const push = throttle<number>(100, (value) => sent.push(value), undefined, timers);
  for (let value = 0; value < 35; value++) {
    push(value);
    timers.advance(10);
  }
  timers.advance(200);
  assert.equal(sent[0], 0);
  assert.equal(sent.at(-1), 34);
  assert.ok(sent.length >= 4 && sent.length <= 5, `${sent.length} sends in 350 ms`);
});

test("waiting values are merged", () => {
  const timers = new FakeTimers();
  const sent: object[] = [];
  const push = throttle<object>(100, (value) => sent.push(value), (a, b) => ({ ...a, ...b }), timers);
  push({ first: 1 });
  push({ height: 1 });
  push({ heading: 2 });
  push({ height: 3 });
  timers.advance(100);
  assert.deepEqual(sent, [{ first: 1 }, { height: 3, heading: 2 }]);
});

test("a value after a quiet time goes at once", () => {
  const timers = new FakeTimers();
  const sent: number[] = [];
  const push = throttle<number>(100, (value) => sent.push(value), undefined, timers);
  push(1);
  timers.advance(500);
  push(2);
  assert.deepEqual(sent, [1, 2]);
});
