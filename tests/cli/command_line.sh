#!/usr/bin/env bash
# What the program's words do. Run from the top of the tree: command_line.sh PROGRAM STAND_IN
# STAND_IN is the same program without physics: it makes runs quick and failures certain.
set -uo pipefail

program=$1 stand_in=$2
case=tests/server/fake_case.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
count=0 failed=0

# fact NAME EXIT STDOUT STDERR COMMAND...: exit code, and what both streams contain ("" = nothing at all
# on stderr; stderr is one line otherwise).
fact() {
    local name=$1 code=$2 out=$3 err=$4 got
    shift 4
    "$@" >"$work/out" 2>"$work/err" </dev/null
    got=$?
    count=$((count + 1))
    if [ "$got" != "$code" ] || { [ -n "$out" ] && ! grep -qF -- "$out" "$work/out"; } ||
        { [ -z "$err" ] && [ -s "$work/err" ]; } ||
        { [ -n "$err" ] && { ! grep -qF -- "$err" "$work/err" || [ "$(wc -l <"$work/err")" != 1 ]; }; }; then
        failed=$((failed + 1))
        echo "FAIL $name: exit $got"
        head -3 "$work/out" "$work/err"
    else
        echo "ok   $name"
    fi
}

# holds NAME COMMAND...: the command succeeds.
holds() {
    local name=$1
    shift
    count=$((count + 1))
    if "$@" >"$work/out" 2>&1; then
        echo "ok   $name"
    else
        failed=$((failed + 1))
        echo "FAIL $name"
        head -3 "$work/out"
    fi
}

fact help_names_the_commands 0 'explain' '' "$program" --help
fact version_is_told 0 'fairlead 0.' '' "$program" --version
fact serve_has_help 0 '--port N' '' "$program" serve --help
fact run_has_help 0 '--until SECONDS' '' "$program" run --help
fact explain_has_help 0 '--json' '' "$program" explain --help
fact help_comes_before_mistakes 0 '--until' '' "$program" run --bogus --help
fact unknown_command_names_the_nearest 2 '' 'did you mean serve?' "$program" srve
fact unknown_flag_names_the_nearest 2 '' 'did you mean --until?' "$program" run x.json --untl 3
fact unknown_flag_of_the_program_itself 2 '' 'did you mean --version?' "$program" --versoin
fact missing_value_is_told 2 '' '--port needs a value' "$program" serve --port
fact port_out_of_range 2 '' 'from 0 to 65535' "$program" serve --port 99999
fact address_that_is_none 2 '' '--bind' "$stand_in" serve $case --bind nowhere --port 0
fact run_needs_an_end 2 '' 'needs --until SECONDS' "$program" run x.json --out "$work/a"
fact run_needs_a_folder 2 '' 'needs --out DIR' "$program" run x.json --until 1
fact run_needs_a_case 2 '' 'needs a CASE' "$program" run --until 1 --out "$work/a"
fact missing_case_is_told 2 '' 'no_such.json' "$program" explain no_such.json
fact bad_override_is_told 2 '' 'fluid.spacing_m' "$program" explain cases/still_water.json \
    --set fluid.spacing_m=-1
fact unknown_override_is_told 2 '' 'spacing' "$program" explain cases/still_water.json \
    --set fluid.spacings_m=1
fact unknown_backend_is_told 2 '' 'auto|cpu|cuda' "$program" run $case --until 1 --out "$work/a" \
    --backend gpu

fact a_run_prints_plain_lines 0 '(100 %)' '' "$stand_in" run $case --until 0.5 --out "$work/run" \
    --frames 4 --set step_ms=0
holds series_has_header_and_samples test "$(wc -l <"$work/run/series.csv")" = 27
holds series_starts_with_time grep -q '^t_s,ship.heave_m,' "$work/run/series.csv"
holds frames_are_numbered test -s "$work/run/frames/frame_000003.png"
holds summary_says_how_it_ended grep -q '"exit":"until reached"' "$work/run/summary.json"
holds journal_begins_with_the_start grep -q '"event":"start"' "$work/run/journal.jsonl"
fact quiet_is_quiet 0 '' '' "$stand_in" run $case --until 0.1 --out "$work/quiet" --quiet --set step_ms=0
holds quiet_prints_nothing test ! -s "$work/out"
fact sick_physics_is_3 3 '' 'not a number' "$stand_in" run $case --until 1 --out "$work/sick" \
    --set step_ms=0 --set fail_at_s=0.3
holds sick_run_has_its_summary grep -q '"status":"failed"' "$work/sick/summary.json"
holds sick_run_keeps_its_series test "$(wc -l <"$work/sick/series.csv")" -ge 15
holds sick_run_journals_why grep -q '"event":"health"' "$work/sick/journal.jsonl"
fact a_folder_that_cannot_be_made 2 '' 'cannot make the folder' "$stand_in" run $case --until 1 \
    --out /dev/null/x
mkdir -p "$work/full"
ln -s /dev/full "$work/full/series.csv"
fact a_full_disk_is_told 2 '' 'series.csv: cannot write: No space left' "$stand_in" run $case \
    --until 0.1 --quiet --out "$work/full"
fact commands_file_missing 2 '' 'cannot read' "$stand_in" run $case --until 1 --out "$work/a" \
    --commands no_such.jsonl
printf '{"event":"start"}\nnonsense\n' >"$work/bad.jsonl"
fact commands_file_names_the_line 2 '' 'line 2' "$stand_in" run $case --until 1 --out "$work/a" \
    --commands "$work/bad.jsonl"
printf '{"event":"command","time_s":0.1,"wave":{"height_m":9}}\n' >"$work/high.jsonl"
fact a_command_out_of_limits_is_told 2 '' 'wave.height_m' "$stand_in" run $case --until 1 \
    --out "$work/a" --commands "$work/high.jsonl" --quiet
printf '{"event":"command","time_s":0.1,"wave":{"height_m":0.1}}\n' >"$work/low.jsonl"
fact a_command_is_replayed 0 '' '' "$stand_in" run $case --until 0.4 --set step_ms=0 \
    --out "$work/low" --commands "$work/low.jsonl" --quiet
holds a_replay_is_journalled grep -q '"time_s":0.1,"wave":{"height_m":0.1' "$work/low/journal.jsonl"
holds two_runs_are_the_same cmp <(head -6 "$work/run/series.csv") <(head -6 "$work/low/series.csv")

fact lines_are_written_on_request 0 '' '' "$program" run tests/good_cases/driven_lines.json --until 0.3 \
    --lines-every 0.1 --out "$work/lines" --quiet
holds line_table_has_a_row_per_node_and_instant test "$(wc -l <"$work/lines/lines.csv")" = $((1 + 4 * 21))
holds line_shapes_are_numbered test -s "$work/lines/lines/lines_000004.vtk"
holds line_shape_is_polydata grep -q '^DATASET POLYDATA$' "$work/lines/lines/lines_000004.vtk"
holds line_shape_has_each_segment grep -q '^LINES 20 60$' "$work/lines/lines/lines_000004.vtk"
holds line_shape_has_tensions grep -q '^CELL_DATA 20$' "$work/lines/lines/lines_000004.vtk"
if command -v node >/dev/null; then
    holds line_shapes_have_their_times node -e '
        const { files } = JSON.parse(require("fs").readFileSync(0, "utf8"));
        if (files.length !== 4 || Math.abs(files[3].time - 0.3) > 1e-6) process.exit(1)' \
        <"$work/lines/lines/lines.vtk.series"
fi
fact a_snap_is_told 0 '' '' "$program" run tests/good_cases/driven_lines.json --until 1.4 --out "$work/snap" \
    --quiet
holds a_snap_is_journalled grep -q '"event":"snap","line":"line_1","tension_n":93' "$work/snap/journal.jsonl"
holds a_snap_is_summed_up grep -q '"snaps":1' "$work/snap/summary.json"
holds samples_fall_on_the_times_asked_for grep -q '^1.4,' "$work/snap/series.csv"
holds no_line_files_unasked test ! -e "$work/run/lines.csv"

fact explain_tells_why 0 'Effects that are left out' '' "$program" explain cases/still_water.json
fact explain_speaks_json 0 '"time_step_s":' '' "$program" explain cases/still_water.json --json
cp "$work/out" "$work/explained"
if command -v node >/dev/null; then
    holds explain_json_has_what_was_promised node -e '
        const e = JSON.parse(require("fs").readFileSync(0, "utf8"));
        const effect = e.effects[0];
        if (!(e.particles > 0 && e.bytes > 0 && e.time_step_s > 0 && effect.name && effect.kind &&
              typeof effect.active === "boolean" && effect.because && effect.called_by && effect.source && effect.bytes >= 0)) process.exit(1)' \
        <"$work/explained"
fi

fact bench_has_help 0 '--particles N' '' "$program" bench --help
fact bench_refuses_an_unknown_scene 2 '' 'still|dam|ship' "$program" bench --scene lake
fact bench_refuses_too_few_particles 2 '' 'from 1000 to' "$program" bench --particles 10
fact bench_refuses_a_narrow_kernel 2 '' 'from 1.2 to 3' "$program" bench --smoothing-ratio 0.9
fact bench_refuses_too_few_steps 2 '' 'from 5 to' "$program" bench --steps 2
fact bench_takes_no_case 2 '' 'one word too many' "$program" bench cases/still_water.json
fact bench_refuses_too_many_particles 2 '' 'from 1000 to' "$program" bench --particles 200000000
fact bench_prints_a_table 0 'one momentum and one density pass' '' "$program" bench --particles 3000 \
    --steps 5 --scene dam --threads 1
if command -v node >/dev/null; then
    for scene in still dam ship; do
        fact "bench_times_the_${scene}" 0 '"scene":"'"$scene"'"' '' "$program" bench --particles 8000 \
            --steps 10 --scene "$scene" --json
        cp "$work/out" "$work/bench.json"
        holds "bench_of_the_${scene}_has_what_was_promised" \
            node tests/cli/bench_report.mjs "$work/bench.json"
    done
fi

echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
