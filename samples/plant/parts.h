#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "samples/plant/sink.h"

/// Parts of a plant, in metres, y up. Closed parts are oriented outward; pipes, sheets and shells are open, as in most
/// real models. Sines and cosines are our own polynomials, so that every machine makes the same bytes.
namespace plant {

constexpr Vec kUp{0, 1, 0};
/// Two unit vectors that make a right-handed frame with `axis`: u x v = axis.
[[nodiscard]] std::array<Vec, 2> across(Vec axis);

struct Turn {
  double cosine, sine;
};
/// Returns the cosine and sine of i/n of a full turn.
[[nodiscard]] Turn turn(int i, int n);
/// Returns turn(0, n) ... turn(n - 1, n). They are kept from call to call, as one thread generates.
[[nodiscard]] const std::vector<Turn>& turns(int n);

class Parts {
 public:
  /// detail multiplies the number of sides of everything round.
  Parts(Sink& sink, std::uint64_t seed, double detail) : random(seed), sink_(sink), detail_(detail) {}
  Random random;

  // Solids and sheets.
  void box(Vec lo, Vec hi);                                    ///< closed
  void beam(Vec a, Vec b, double width, double height);        ///< closed bar from a to b
  void sheet(Vec corner, Vec u, Vec v, int across, int up);    ///< open, in one piece
  void zigzag(Vec corner, Vec u, Vec v, int waves, Vec rise);  ///< corrugated sheet, open
  /// Turns a profile of (radius, height) around an axis. A radius of 0 closes an end; `loop` joins last and first.
  void lathe(Vec base, Vec axis, const std::vector<std::array<double, 2>>& profile, int sides, bool loop = false);
  void cylinder(Vec base, Vec axis, double radius, double length, int sides);  ///< closed
  void ring(Vec center, Vec axis, double radius, double thickness, int sides, int around);
  /// Pipe through the points, corners rounded by `bend`; its ends are open unless capped.
  void tube(const std::vector<Vec>& points, double radius, int sides, double bend = 0, bool capped = false);
  void cable(Vec a, Vec b, double sag, double radius);

  // Equipment.
  void pipe(const std::vector<Vec>& points, double radius);  ///< with flanges, here and there a valve
  void flange(Vec center, Vec axis, double radius);
  void valve(Vec center, Vec axis, double radius);
  void pump(Vec at, bool along_x);
  void ladder(Vec foot, double height, Vec outward, bool caged);
  void stairs(Vec foot, Vec run, double rise, double width);
  void railing(const std::vector<Vec>& points);
  void platform(Vec lo, double dx, double dz, bool railed);
  void wall(Vec corner, Vec along, double length, double height, int openings, bool door);
  void drum(Vec at);
  void tank(Vec center, double radius, double height, bool dome);
  void column(Vec center, double radius, double height);
  void vessel(Vec center, Vec axis, double radius, double length);
  void sphere_tank(Vec center, double radius);
  void silo(Vec center, double radius, double height);
  void frame(Vec corner, int bays_x, int bays_z, int levels, double bay, double storey);

 private:
  void box_faces();
  [[nodiscard]] int sides(int n) const;
  Sink& sink_;
  double detail_;
};

}  // namespace plant
