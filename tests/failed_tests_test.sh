#!/usr/bin/env bash
# failed_tests.awk of a log as ctest 3.25 writes it: one that passed, one skipped, one that failed, one that timed out
# without a word, and a program of many tests of which two failed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
told=$(awk -v name=asan -f "$here/failed_tests.awk" <<'LOG'
        Start   1: Bus.Sends
  1/5 Test   #1: Bus.Sends .........................   Passed    0.03 sec
        Start   2: Bus.Alone
  2/5 Test   #2: Bus.Alone .........................***Skipped   0.03 sec
skipped: no kernel with CAN
        Start   4: all_of_one
        Start   5: Lamp.Waits
  3/5 Test   #3: Lamp.Shines .......................***Failed    0.10 sec
[==========] Running 1 test from 1 test suite.
[ RUN      ] Lamp.Shines
lamp_test.cpp:7: Failure
dark
[  FAILED  ] Lamp.Shines (3 ms)
[  FAILED  ] 1 test, listed below:
[  FAILED  ] Lamp.Shines

  4/5 Test   #5: Lamp.Waits ........................***Timeout 300.02 sec
  5/5 Test   #4: all_of_one ........................***Failed   90.10 sec
[ RUN      ] Drive.Begins
[       OK ] Drive.Begins (1 ms)
[ RUN      ] Drive.Ends
drive_test.cpp:9: Failure
[  FAILED  ] Drive.Ends (2 ms)
[ RUN      ] Drive.Goes
[       OK ] Drive.Goes (1 ms)
[ RUN      ] Drive.Turns/left, where GetParam() = 1
[  FAILED  ] Drive.Turns/left, where GetParam() = 1 (2 ms)

40% tests passed, 3 tests failed out of 5

The following tests FAILED:
	  3 - Lamp.Shines (Failed)
LOG
)
wanted='failed (asan): #3: Lamp.Shines***Failed    0.10 sec
  [ RUN      ] Lamp.Shines
  lamp_test.cpp:7: Failure
  dark
  [  FAILED  ] Lamp.Shines (3 ms)
failed (asan): #5: Lamp.Waits***Timeout 300.02 sec
failed (asan): #4: all_of_one***Failed   90.10 sec
  [ RUN      ] Drive.Ends
  drive_test.cpp:9: Failure
  [  FAILED  ] Drive.Ends (2 ms)
  [ RUN      ] Drive.Turns/left, where GetParam() = 1
  [  FAILED  ] Drive.Turns/left, where GetParam() = 1 (2 ms)'
diff <(printf '%s\n' "$wanted") <(printf '%s\n' "$told")
