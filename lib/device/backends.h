#pragma once
#include <memory>
#include <vector>

namespace bp {

class Backend;

/// One backend per worker thread. Stages hand tile i to any idle backend. Headers that only pass backends on need not
/// know what a backend does (backend.h).
using Backends = std::vector<std::unique_ptr<Backend>>;

}  // namespace bp
