// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the engine of the studies wears: quickly at first, then evenly, as the exponential approximations of Endurthi's
// thesis, which it does not give (read so that they fit a published table):
//   h(c) = a (1 - exp(-c/300)) + b c,   c cycles
// a is the table's initial wear, b the least-squares slope through its values after 3000 and 6000 cycles. Of the HPC the
// table used has one value, after 3000 cycles (half_worn.h): a is 0 there. Fractions, in the order of health_names.
// Source of the table: Chatterjee & Litt, NASA/TM-2003-212607. Errors: none.

#include "engine_sim/model/gas_path.h"

namespace ehm::tuner_design::endurthi {

engine_sim::HealthVector worn_after(double cycles);

}  // namespace ehm::tuner_design::endurthi
