// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/mapss_model.h"

#include <Eigen/Core>

namespace ehm::tuner_design {
namespace {

// Row by row, as published: deviations, health in fractions of nominal.
constexpr int states = 3, controls = 3, health = 8, sensors = 11;
constexpr double state_matrix[states * states] = {0.9029193407,     0.04111403668,    0.03806970487,
                                                  -0.006928588131,  0.9088057181,     0.0431634347,
                                                  -6.795925869e-05, -0.0004093730037, 0.9923956812};
constexpr double state_control[states * controls] = {0.04346970084,   0.3183070241,    -0.09287855285,
                                                     0.05664270645,   0.1125822493,    -0.03216979603,
                                                     0.0004031578367, 0.0005848007007, -0.000188215559};
constexpr double state_health[states * health] = {
    -294.2883866, 254.1007193,  -8.883366665,  241.4922413,  -47.2502834,  10.01736695,  -19.62859064,  -365.4922306,
    -17.63914533, -38.47350975, -131.9580477,  -274.2797026, 449.5393317,  -61.99136431, 302.5021405,   126.9419115,
    0.1597989178, -1.284447272, 0.02615455609, -2.324786204, -3.327840225, -1.428797956, -0.1424665592, -0.02000359575};
constexpr double sensor_state[sensors * states] = {-0.003379477211,  1,
                                                   0.02367592177,    0.008738,
                                                   0.0001914892639,  0.0001735231816,
                                                   0.001606235955,   -0.0005575616347,
                                                   0.0001398702225,  0.002243045336,
                                                   -0.0005116147078, 0.0001167246734,
                                                   0.01807916884,    -0.00240614056,
                                                   0.0008207950338,  0.01480536605,
                                                   0.04934250129,    0.009444358499,
                                                   0.001803972234,   4.948980325e-05,
                                                   0.0002399745209,  0.003024017531,
                                                   0.01265762936,    0.004760075314,
                                                   -0.001188343462,  -0.0302477971,
                                                   0.06564198169,    -0.01718205297,
                                                   -0.1098380955,    0.1218396049,
                                                   0.00100504031,    0.000656905305,
                                                   0.0003556402498};
constexpr double sensor_control[sensors * controls] = {
    0.00198398527,   0.01260357194,  -0.003609574188, -0.0001129595068, -0.0001809726231, 5.210016925e-05,
    0.0001563690473, -0.01178784394, -0.008405708365, 7.397938451e-05,  -0.008168399488,  -0.005778917162,
    0.0004947455601, -0.05101738179, -0.03609899603,  0.02391097963,    -0.03170962639,   -0.02690694348,
    0.0003738099632, -0.01994856055, -0.01435987251,  0.01181247,       0.001785539773,   -0.0008780501662,
    0.1294453202,    -0.1911723041,  0.05882327853,   0.2349796607,     -0.3506349819,    0.1445535005,
    0.0008078144344, -0.02765419423, 0.01147070517};
constexpr double sensor_health[sensors * health] = {
    -2.533031966,   -21.87587816,   -64.95615236,  -161.0029958,  240.9108776,   -34.55046346,  160.8763912,
    66.6444046,     -1.349594448,   1.191400151,   0.01131440726, 1.101569442,   -0.2964891432, 0.04163044991,
    -0.1416857073,  -1.712844919,   2.271725812,   -0.2729322239, -1.478665807,  -1.903754388,  -0.5123560373,
    -0.07341643627, -0.3333503081,  -0.2628881672, 5.664259522,   -0.3723191036, -1.459562499,  -1.674963979,
    -0.4341078473,  -0.07413005516, -0.2730944218, -0.4131875235, 30.30312354,   -62.35202671,  -6.331343302,
    -7.771420045,   -2.650626694,   -0.320676703,  -1.653702539,  -3.33291311,   27.37027459,   -65.95048046,
    -8.52579013,    128.5379553,    -391.3869158,  -161.7529389,  6.30741459,    0.5186934368,  5.449311544,
    -0.02090719764, 1.971135514,    -0.4036615262, -0.4561244721, 0.02685391948, -0.3159434993, -0.1624627336,
    1.415461076,    10.56713366,    -1.047539621,  52.23225428,   -2.796215464,  -93.10142006,  1.959549621,
    0.1496348685,   31.09472481,    -124.3117751,  3.650163935,   -201.6218123,  -340.3074651,  -76.28219498,
    -101.8336094,   52.72721601,    34.81917503,   -182.6730697,  15.826118,     -531.78158,    -289.2280145,
    9.188548913,    -209.9746334,   104.9357386,   2.749944274,   0.4834462115,  0.8790794056,  2.303842375,
    -0.5266210058,  0.2287156761,   -0.4033582294, 0.129750795};
constexpr double process_variance[states] = {0.1319197633, 0.3691640107, 0.005873238871};
constexpr double sensor_variance[sensors] = {6562.915746, 0.1790652928, 0.007899770663, 0.01019572509,
                                             33.73125731, 23.28327833,  0.04269846386,  0.7235466214,
                                             283.8495328, 194.2237643,  0.03737918223};
constexpr const char* health_names[health] = {"fan_flow", "fan_efficiency", "hpc_flow", "hpc_efficiency",
                                              "hpt_flow", "hpt_efficiency", "lpt_flow", "lpt_efficiency"};

template <int Rows, int Cols>
Eigen::MatrixXd matrix(const double* rows) {
  return Eigen::Map<const Eigen::Matrix<double, Rows, Cols, Eigen::RowMajor>>(rows);
}

}  // namespace

linear_model::LinearModel mapss_model() {
  linear_model::LinearModel model;
  model.name = "MAPSS military turbofan, D. Simon 2004";
  model.sample_time_s = 0.1;
  for (int i = 1; i <= states; ++i) model.states.push_back({"x" + std::to_string(i), "-", 0.0});
  for (int i = 1; i <= controls; ++i) model.controls.push_back({"u" + std::to_string(i), "-", 0.0});
  for (const char* name : health_names) model.health.push_back({name, "fraction", 0.0});
  for (int i = 1; i <= sensors; ++i) model.sensors.push_back({"y" + std::to_string(i), "-", 0.0});
  model.A = matrix<states, states>(state_matrix);
  model.B = matrix<states, controls>(state_control);
  model.L = matrix<states, health>(state_health);
  model.C = matrix<sensors, states>(sensor_state);
  model.D = matrix<sensors, controls>(sensor_control);
  model.M = matrix<sensors, health>(sensor_health);
  model.F.resize(0, states);
  model.G.resize(0, controls);
  model.N.resize(0, health);
  model.process_noise = Eigen::Map<const Eigen::Vector3d>(process_variance).asDiagonal();
  model.sensor_noise_sigma = Eigen::Map<const Eigen::VectorXd>(sensor_variance, sensors).cwiseSqrt();
  model.health_sigma = Eigen::VectorXd::Constant(health, 0.02);
  return model;
}

}  // namespace ehm::tuner_design
