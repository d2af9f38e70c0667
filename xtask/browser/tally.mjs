// Claims about a page, counted; the last line is one of `cargo test`.

const tally = { passed: 0, failed: 0 };

/** Prints whether a claim is true and, if it is not, what was seen instead. */
export function holds(claim, isTrue, seen) {
  tally[isTrue ? "passed" : "failed"]++;
  console.log(`report ${claim} ... ${isTrue ? "ok" : `FAILED: ${JSON.stringify(seen)}`}`);
}

/** Prints the sums; gives the exit status. */
export function concluded() {
  const result = tally.failed ? "FAILED" : "ok";
  console.log(`test result: ${result}. ${tally.passed} passed; ${tally.failed} failed`);
  return tally.failed ? 1 : 0;
}
