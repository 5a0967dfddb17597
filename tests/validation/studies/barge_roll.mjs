// A barge let go in roll against its natural period as measured in a tank.
import { atMost } from '../harness.mjs';
import { swingPeaks, swingPeriod } from '../signal.mjs';

const END = 3.2, MEASURED = 0.93;

function compare(simulate) {
  const run = simulate('barge_roll', { until: END }), roll = run.column('barge.pitch_deg');
  const period = swingPeriod(run.time, roll), peaks = swingPeaks(run.time, roll, 5);
  return {
    bars: [atMost('period off the measured 0.93 s', period / MEASURED - 1, 0.03, '%')],
    notes: [`Period ${period.toFixed(3)} s; extremes after 15 deg: ${peaks.map((p) => p.toFixed(1)).join(', ')} deg, of which no measured figures are at hand.`],
    plot: { panels: [{ x: 't [s]', y: 'roll [deg]', xrange: [0, END], curves: [{ label: 'simulated', x: run.time, y: roll }] }] },
  };
}

export const studies = [{ name: 'barge_roll', title: 'Roll decay of a barge from 15 deg, 2-D', reference: 'Jung et al. 2006', compare }];
