#include "tools/view/made_proxies.h"

#include <algorithm>

#include "lib/core/error.h"

namespace bp {

void MadeProxies::add(const ProxyJob::Status& job) {
  if (job.step != ProxyJob::Step::ready || job.file == nullptr || job.verdict.is_null()) return;
  if (!made_.empty() && made_.back().number >= job.number) return;
  const Json levels = job.verdict.value("levels", Json::array());
  if (levels.empty()) return;
  Json facts = levels.front();
  facts["number"] = job.number;
  facts["revision"] = job.revision;
  facts["faces"] = job.faces;
  facts["answer"] = job.verdict.value("answer", Json());
  made_.push_back({job.number, std::move(facts), job.file});
  kept_bytes_ += job.file->size();
  while (made_.size() > kMost || (made_.size() > 1 && kept_bytes_ > bytes_)) {
    kept_bytes_ -= made_.front().file->size();
    made_.pop_front();
  }
}

Json MadeProxies::json() const {
  Json all = Json::array();
  for (const Made& one : made_) all.push_back(one.facts);
  return all;
}

std::shared_ptr<const std::string> MadeProxies::file(std::uint64_t number) const {
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Made& one) { return one.number == number; });
  if (found == made_.end()) fail(ErrorCode::bad_argument, "there is no proxy {} any more", number);
  return found->file;
}

}  // namespace bp
