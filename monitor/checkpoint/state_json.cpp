// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/state_json.h"

#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::monitor::state_json {

void defect(const files::JsonObject& object, const std::string& name, const files::Json& value,
            const std::string& allowed) {
  files::throw_defect(object.file(), object.key(name), files::shown(value), allowed, remedy);
}

std::string hashed_text(files::Json content) {
  content["hash"] = files::sha256_hex(content.dump());
  return content.dump() + "\n";
}

void require_hash(files::JsonObject& root, files::Json content) {
  const std::string stated = root.text("hash");
  content.erase("hash");
  const std::string actual = files::sha256_hex(content.dump());
  if (stated != actual) defect(root, "hash", stated, "\"" + actual + "\", the SHA-256 of the content");
}

void require_moderate(const files::JsonObject& object, const std::string& name, const Eigen::MatrixXd& values) {
  constexpr double largest = 1e9;
  if (values.size() > 0 && values.cwiseAbs().maxCoeff() > largest)
    defect(object, name, values.cwiseAbs().maxCoeff(), "magnitudes up to " + files::shown(largest));
}

void require_covariance(const files::JsonObject& object, const Eigen::MatrixXd& covariance) {
  constexpr double rounding = 1e-9;
  const double size = covariance.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    if (covariance(i, i) < 0.0)
      defect(object, "covariance[" + std::to_string(i) + "][" + std::to_string(i) + "]", covariance(i, i),
             "a variance, 0 or more");
  const double skew = (covariance - covariance.transpose()).cwiseAbs().maxCoeff();
  if (skew > rounding * size) defect(object, "covariance", skew, "symmetric: its two halves differ by as much");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance, Eigen::EigenvaluesOnly);
  if (const double least = solver.eigenvalues().minCoeff(); least < -rounding * size)
    defect(object, "covariance", least, "a least eigenvalue of 0 or more");
}

files::Json learned_to_json(const estimation::Learned& learned, const std::string& file, const std::string& key) {
  return {{"value", files::vector_to_json(learned.value, file, key + ".value")},
          {"covariance", files::to_json(learned.covariance, file, key + ".covariance")}};
}

estimation::Learned learned_from_json(files::JsonObject& root, const std::string& key, Eigen::Index length) {
  files::JsonObject object(root.at(key), root.file(), root.key(key));
  estimation::Learned learned;
  learned.value = object.vector("value", length);
  learned.covariance = object.matrix("covariance", length, length);
  object.refuse_unknown();
  require_moderate(object, "value", learned.value);
  require_moderate(object, "covariance", learned.covariance);
  require_covariance(object, learned.covariance);
  return learned;
}

}  // namespace ehm::monitor::state_json
