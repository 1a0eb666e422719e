#pragma once
#include <memory>

namespace bp {

/// Working memory of close_tile, kept between calls. One per thread.
class ClosingScratch {
 public:
  struct Parts;  ///< private to lib/closing
  ClosingScratch();
  ~ClosingScratch();
  ClosingScratch(const ClosingScratch&) = delete;
  ClosingScratch& operator=(const ClosingScratch&) = delete;
  [[nodiscard]] Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace bp
