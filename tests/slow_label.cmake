# SPDX-License-Identifier: Apache-2.0
# Read by ctest right after the list of a program's slow tests (ehm_test): gtest_discover_tests passes no second label on.
if(slow_tests)
  set_tests_properties(${slow_tests} PROPERTIES LABELS "unit;slow")
endif()
