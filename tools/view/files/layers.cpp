#include "tools/view/files/layers.h"

#include "io/mesh/contract.h"
#include "lib/core/error.h"
#include "tools/view/verdict.h"

namespace bp {

namespace {

const char* kind_name(ShownFile::Kind kind) {
  constexpr const char* kNames[] = {"mesh", "tileset", "voxels"};
  return kNames[std::size_t(kind)];
}

std::optional<Contract> contract_of(const ShownFile& file) {
  return contract_named(file.extras.contract);
}

}  // namespace

Layers::Layers(const ViewOptions& options, std::function<void()> changed)
    : options_(options), files_(shown_files(options.shown)), changed_(std::move(changed)), states_(files_.size()) {}

const ShownFile& Layers::file(std::size_t i) const {
  if (i >= files_.size()) fail(ErrorCode::bad_argument, "there is no file {}", i);
  return files_[i];
}

void Layers::check(std::size_t i) {
  if (file(i).kind == ShownFile::Kind::voxels)
    fail(ErrorCode::bad_argument, "{}: voxels are not proven; bpcheck proves meshes", file(i).name);
  {
    const std::lock_guard lock(mutex_);
    if (states_[i].step == Step::waiting || states_[i].step == Step::checking) return;
    states_[i] = {Step::waiting, {}, {}};
  }
  worker_.add([this, i](ToolPipe& pipe) {
    try {
      prove(pipe, i);
    } catch (const std::exception& e) {
      set(i, {Step::failed, {}, e.what()});
    }
  });
  changed_();
}

void Layers::set(std::size_t i, State state) {
  {
    const std::lock_guard lock(mutex_);
    states_[i] = std::move(state);
  }
  changed_();
}

void Layers::prove(ToolPipe& pipe, std::size_t i) {
  set(i, {Step::checking, {}, {}});
  const ShownFile& shown = files_[i];
  ToolCommand command = check_command(options_, shown.path);
  if (contract_of(shown)) command.push_back("--claimed");
  const MemoryFile text;
  const ToolResult result = pipe.run({command}, {}, text);
  if (result.stopped) return;
  const Json verdict = brief_verdict(text.bytes());
  if (verdict.is_null()) {
    set(i, {Step::failed, {}, result.said});
  } else {
    set(i, {Step::done, std::make_shared<const Json>(verdict), result.said});
  }
}

Json Layers::json() const {
  constexpr const char* kSteps[] = {"none", "waiting", "checking", "done", "failed"};
  const std::lock_guard lock(mutex_);
  Json all = Json::array();
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const ShownFile& f = files_[i];
    const auto contract = contract_of(f);
    all.push_back({{"name", f.name},
                   {"kind", kind_name(f.kind)},
                   {"levels", f.levels},
                   {"contract", f.extras.contract},
                   {"claims", contract ? claim_of(*contract) : ""},
                   {"not_claimed", contract ? not_claimed_by(*contract) : ""},
                   {"made_by", f.extras.provenance},
                   {"step", kSteps[std::size_t(states_[i].step)]},
                   {"verdict", states_[i].verdict ? *states_[i].verdict : Json()},
                   {"notes", states_[i].notes}});
  }
  return all;
}

}  // namespace bp
