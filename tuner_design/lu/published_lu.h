// SPDX-License-Identifier: Apache-2.0
#pragma once
// The figures of tables 4 to 9 of Lu, Huang & Lv (cEKPF), as printed; one run of their engine each. In percent of
// nominal, SME too (their tables 4 and 5 are in 1e-4 to 1e-2 of one, table 6 in 1e-2, tables 8 and 9 in 1e-2 by a reading).

#include <array>

#include "tuner_design/lu/lu_engine.h"

namespace ehm::tuner_design::published {

struct Lu {
  std::array<double, lu_health_count> mean, sigma;
};
/// [fault - 1][EKF, PF, cEKPF]
using LuTable = std::array<std::array<Lu, 3>, 2>;

// clang-format off
inline constexpr LuTable table_4{{
    {{{{-.0442, .0847, .0008, .0774, -.1122, -.0217, -.0308}, {.165, .089, .096, .105, .096, .081, .111}},
      {{.5253, .0752, -.0329, .0554, -.3473, -.0404, .1728}, {.954, .439, .441, .419, .628, .260, .501}},
      {{.0055, .0075, .0427, .0479, -.1407, -.0528, -.0449}, {.552, .241, .286, .204, .307, .155, .296}}}},
    {{{{.0289, .0812, -.0128, .0820, -.0856, -.0251, -.0302}, {.146, .127, .088, .103, .113, .097, .114}},
      {{.0303, .1638, -.0195, .1225, .0771, -.0527, -.2476}, {1.263, .436, .554, .524, .725, .326, .531}},
      {{-.0288, .0897, .0181, .1149, -.0823, -.0526, -.0498}, {.469, .218, .270, .239, .325, .161, .291}}}}}};
inline constexpr LuTable table_5{{
    {{{{12.272, 4.390, -2.178, -.684, 1.668, 2.032, 2.804}, {4.32, 1.50, .61, .30, .25, .71, .85}},
      {{.132, -.011, -.195, .004, -.244, -.042, .045}, {.97, .45, .42, .44, .70, .28, .57}},
      {{-.101, -.043, -.082, .007, -.230, -.141, -.146}, {.60, .20, .28, .24, .32, .16, .30}}}},
    {{{{8.697, 3.775, -1.928, -.557, .234, 1.699, 2.085}, {1.52, .63, .31, .17, .20, .43, .51}},
      {{.223, .044, -.168, -.166, -.210, -.129, -.191}, {.67, .39, .41, .39, .60, .28, .48}},
      {{-.162, .011, -.116, .003, -.116, -.123, -.174}, {.53, .24, .25, .22, .31, .15, .29}}}}}};
// clang-format on
/// EKF, PF, cEKPF: Gaussian, Rayleigh.
inline constexpr std::array<std::array<double, 3>, 2> table_6{{{6.74, 7.61, 6.85}, {21.66, 8.19, 6.93}}};
/// Seconds a second of data: EKF, PF, cEKPF; faults 1, 2.
inline constexpr std::array<std::array<double, 3>, 2> table_7{{{7.7, 27.0, 23.0}, {7.7, 26.7, 21.8}}};
/// By missing sensor, in the order of lu_sensor_names as the paper lists them (N1 N2 P13 T24 P24 T3 P3 T5 P5); below 0:
/// diverged.
inline constexpr std::array<double, lu_sensor_count> table_8_ekpf{-1, .875, -1, -1, 1.001, .632, .284, 1.552, .909};
inline constexpr std::array<double, lu_sensor_count> table_8_cekpf{.276, .207, .188, .195, .193,
                                                                   .187, .191, .198, .196};
/// SME and seconds of 10 s of data: [fault - 1][N = 30, 50, 100]
inline constexpr std::array<std::array<double, 3>, 2> table_9_sme{{{.366, .343, .342}, {.472, .438, .432}}};

}  // namespace ehm::tuner_design::published
