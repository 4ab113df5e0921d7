#include "solids/families.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace morsel::solids {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint64_t kPoseStream = 0x6a6f696e7473ULL;

// Along x, y, z turned about the y axis: positive angles turn x down towards -z.
Frame pitched(double degrees) {
  const double c = std::cos(degrees * kDegree);
  const double s = std::sin(degrees * kDegree);
  return {Vec3{c, 0, -s}, Vec3{0, 1, 0}, Vec3{s, 0, c}};
}

// A direction in the plane y = 0: 0 degrees ahead (x), 90 up.
Vec3 ahead(double degrees, double aside = 0.0) {
  const double level = std::cos(aside * kDegree);
  return {level * std::cos(degrees * kDegree), std::sin(aside * kDegree),
          level * std::sin(degrees * kDegree)};
}

// What the families are made with: pieces are added to `solid`, proportions and joints vary.
class Maker {
 public:
  explicit Maker(const Member& member)
      : proportions_(Random((member.family << 32U) ^ member.number).next()),
        joints_(Random((member.family << 32U) ^ member.number ^ kPoseStream).next() ^
                Random(member.pose).next()) {}

  // The value, up to a quarter more or less, or the given share.
  double vary(double value, double by = 0.25) {
    return value * (1.0 + by * (2.0 * proportions_.uniform() - 1.0));
  }
  bool chance(double share) { return proportions_.uniform() < share; }
  // An angle in degrees.
  double joint(double middle, double by) { return middle + by * (2.0 * joints_.uniform() - 1.0); }
  // Pieces that follow belong to another part.
  void next_part() { ++part_; }

  void add(const Body& body) { solid_.push_back({.body = body, .part = part_}); }
  void drill(const Body& body) { solid_.push_back({.body = body, .hole = true}); }
  // A limb of pieces of the given thickness at their ends; returns where it ends.
  Vec3 limb(const Vec3& from, const Vec3& step, double radius, double end_radius) {
    add(Limb{from, from + step, radius, end_radius});
    return from + step;
  }

  [[nodiscard]] Solid take() { return std::move(solid_); }

 private:
  Random proportions_;
  Random joints_;
  Solid solid_;
  int part_ = 0;
};

constexpr std::array<double, 2> kSides{1.0, -1.0};

void make_animal(Maker& m) {
  const double length = m.vary(1.0);
  const double girth = m.vary(0.36);
  m.add(Limb{{-0.5 * length, 0, 0}, {0.5 * length, 0, 0.05}, girth, m.vary(girth, 0.15)});
  m.next_part();
  const Vec3 nape =
      Vec3{0.5 * length + 0.2, 0, 0.2} + m.vary(0.5, 0.4) * ahead(m.joint(50, 20), m.joint(0, 15));
  m.add(Limb{{0.5 * length, 0, 0.1}, nape, m.vary(0.22), 0.17});
  m.next_part();
  const double snout = m.vary(0.4);
  const double skull = m.vary(0.24);
  m.limb(nape, snout * ahead(m.joint(-25, 15)), skull, 0.6 * skull);
  const double leg = m.vary(0.85, 0.35);
  const double thick = m.vary(0.13);
  for (const double end : {0.42, -0.42}) {
    for (const double side : kSides) {
      m.next_part();
      const Vec3 knee =
          m.limb({end * length, side * 0.55 * girth, -0.1},
                 (0.5 * leg + 0.2) * ahead(m.joint(-90, 22), 5 * side), 1.3 * thick, thick);
      m.limb(knee, 0.5 * leg * ahead(m.joint(-90, 12)), thick, 0.85 * thick);
    }
  }
  m.next_part();
  m.limb({-0.5 * length - 0.8 * girth, 0, 0.15}, m.vary(0.6, 0.5) * ahead(m.joint(170, 40), 8),
         m.vary(0.09), 0.07);
}

// On two legs, big head, heavy tail.
void make_biped_dinosaur(Maker& m) {
  const double girth = m.vary(0.36);
  const Vec3 hip{-0.2, 0, 0};
  const Vec3 chest = m.limb(hip, m.vary(0.8) * ahead(m.joint(35, 10)), girth, 0.8 * girth);
  m.next_part();
  const Vec3 nape = m.limb(chest, m.vary(0.8, 0.2) * ahead(m.joint(60, 15)), 0.2, 0.16);
  m.next_part();
  m.limb(nape, m.vary(0.55) * ahead(m.joint(-8, 12), m.joint(0, 15)), m.vary(0.27), 0.15);
  m.next_part();
  const Vec3 bend_of_tail =
      m.limb(hip, m.vary(0.8) * ahead(m.joint(188, 8), m.joint(0, 10)), 0.8 * girth, 0.18);
  m.limb(bend_of_tail, m.vary(0.8) * ahead(m.joint(178, 12), m.joint(0, 20)), 0.18, 0.07);
  const double leg = m.vary(1.1, 0.2);
  for (const double side : kSides) {
    m.next_part();
    const Vec3 knee = m.limb(hip + Vec3{0, side * 0.75 * girth, 0},
                             0.5 * leg * ahead(m.joint(-65, 15)), 0.24, 0.15);
    const Vec3 ankle = m.limb(knee, 0.5 * leg * ahead(m.joint(-115, 15)), 0.14, 0.1);
    m.limb(ankle, m.vary(0.3) * ahead(-5), 0.11, 0.09);
  }
  for (const double side : kSides) {
    m.next_part();
    m.limb(chest + Vec3{0.05, side * 0.7 * girth, -0.05},
           m.vary(0.42) * ahead(m.joint(-40, 25), 15 * side), 0.09, 0.07);
  }
}

// On four legs, long neck, small head, long tail.
void make_long_necked_dinosaur(Maker& m) {
  const double length = m.vary(0.8);
  const double girth = m.vary(0.42);
  m.add(Limb{{-0.5 * length, 0, 0}, {0.5 * length, 0, 0}, girth, 0.9 * girth});
  m.next_part();
  const Vec3 middle = m.limb({0.5 * length + 0.1, 0, 0.1},
                             m.vary(0.85) * ahead(m.joint(45, 15), m.joint(0, 15)), 0.25, 0.15);
  const Vec3 nape =
      m.limb(middle, m.vary(0.75) * ahead(m.joint(50, 22), m.joint(0, 20)), 0.15, 0.11);
  m.next_part();
  m.limb(nape, m.vary(0.3) * ahead(m.joint(-15, 15)), 0.17, 0.12);
  m.next_part();
  const Vec3 tail = m.limb({-0.5 * length - 0.1, 0, 0},
                           m.vary(0.9) * ahead(m.joint(190, 10), m.joint(0, 15)), 0.26, 0.13);
  m.limb(tail, m.vary(0.8) * ahead(m.joint(180, 12), m.joint(0, 25)), 0.13, 0.06);
  const double leg = m.vary(0.85);
  for (const double end : {0.45, -0.45}) {
    for (const double side : kSides) {
      m.next_part();
      m.limb({end * length, side * 0.6 * girth, -0.15}, leg * ahead(m.joint(-90, 15), 4 * side),
             m.vary(0.17, 0.15), 0.14);
    }
  }
}

void make_blade(Maker& m) {
  const double length = m.vary(2.0, 0.35);
  const double width = m.vary(0.2);
  const double thickness = m.vary(0.085, 0.15);
  m.add(Ellipsoid{{0.1 + 0.5 * length, 0, 0}, {0.62 * length, width, thickness}});
  m.next_part();
  const double guard = m.vary(0.45, 0.4);
  m.add(Limb{{0, -guard, 0}, {0, guard, 0}, 0.1, 0.1});
  m.next_part();
  const double grip = m.vary(0.65, 0.3);
  m.add(Limb{{-0.05, 0, 0}, {-grip, 0, 0}, 0.11, m.vary(0.11)});
  m.next_part();
  m.add(Limb{{-grip - 0.12, 0, 0}, {-grip - 0.12, 0, 0}, m.vary(0.19, 0.2), 0.0});
}

void make_car(Maker& m) {
  const double length = m.vary(1.15, 0.2);
  const double width = m.vary(0.5, 0.15);
  const double height = m.vary(0.24);
  m.add(Block{{0, 0, 0}, {length, width, height}});
  m.next_part();
  const double cabin = m.vary(0.55, 0.3);
  const double roof = m.vary(0.3, 0.3);
  const double at = m.vary(0.15, 1.5) - 0.25;
  m.add(Block{{at, 0, height + 0.5 * roof}, {cabin, 0.86 * width, 0.5 * roof + 0.1}});
  if (m.chance(0.5)) {
    m.add(Block{{at - 0.1, 0, height + 0.3 * roof}, {cabin + 0.2, 0.8 * width, 0.3 * roof + 0.1}});
  }
  const double wheel = m.vary(0.27, 0.15);
  for (const double end : {0.62, -0.62}) {
    for (const double side : kSides) {
      m.next_part();
      const Vec3 hub{end * length, side * width, -height - 0.02};
      m.add(Frustum{hub + Vec3{0, -0.12 * side, 0}, hub + Vec3{0, 0.1 * side, 0}, wheel, wheel});
    }
  }
}

void make_chair(Maker& m) {
  const double half = m.vary(0.55, 0.2);
  const double depth = m.vary(0.52, 0.2);
  const double board = m.vary(0.085, 0.15);
  m.add(Block{{0, 0, 0}, {depth, half, board}});
  m.next_part();
  const double back = m.vary(0.6, 0.3);
  const double slant = m.vary(6, 1.0);
  m.add(
      Block{{-depth + 0.05 - 0.012 * slant * back, 0, back}, {0.08, half, back}, pitched(-slant)});
  const double leg = m.vary(0.95, 0.25);
  const double thick = m.vary(0.09, 0.15);
  for (const double end : kSides) {
    for (const double side : kSides) {
      m.next_part();
      const Vec3 top{end * (depth - 0.12), side * (half - 0.12), 0};
      m.add(Frustum{top, top + Vec3{0.06 * end, 0.06 * side, -leg}, 1.15 * thick, thick});
    }
  }
  if (!m.chance(0.35)) return;
  for (const double side : kSides) {
    m.next_part();
    const Vec3 elbow{0.7 * depth, side * (half - 0.02), 0.5};
    m.add(Limb{{-depth, elbow.y, elbow.z}, elbow, 0.085, 0.085});
    m.add(Limb{elbow, {elbow.x, elbow.y, 0}, 0.085, 0.085});
  }
}

void make_chess_piece(Maker& m) {
  const double foot = m.vary(0.62, 0.15);
  const double base = m.vary(0.26);
  m.add(Frustum{{0, 0, 0}, {0, 0, base}, foot, 0.85 * foot});
  m.next_part();
  const double height = base + m.vary(1.0, 0.4);
  const double neck = m.vary(0.24);
  m.add(Frustum{{0, 0, base - 0.05}, {0, 0, height}, 0.6 * foot, neck});
  m.next_part();
  m.add(Frustum{{0, 0, height}, {0, 0, height + 0.13}, m.vary(0.42, 0.15), 0.36});
  m.next_part();
  const double head = m.vary(0.36, 0.2);
  const double top = height + 0.1 + 0.75 * head;
  m.add(Ellipsoid{{0, 0, top}, {head, head, m.vary(head, 0.3)}});
  if (m.chance(0.5)) m.add(Limb{{0, 0, top}, {0, 0, top + 1.3 * head}, 0.14, 0.09});
}

void make_fish(Maker& m) {
  const double length = m.vary(1.15, 0.2);
  const double height = m.vary(0.46, 0.3);
  m.add(Ellipsoid{{0, 0, 0}, {length, m.vary(0.26), height}});
  m.next_part();
  const double tail = m.vary(0.42);
  const double sway = m.joint(0, 20);
  for (const double side : kSides) {
    m.add(Ellipsoid{Vec3{-length, 0, 0} + 0.7 * tail * ahead(180 - 38 * side, sway),
                    {tail, 0.075, 0.2},
                    pitched(-38 * side)});
  }
  m.next_part();
  m.add(Ellipsoid{{m.vary(-0.1, 2.0), 0, 0.9 * height}, {m.vary(0.4), 0.07, m.vary(0.3)}});
  for (const double side : kSides) {
    m.next_part();
    m.limb({0.4 * length, 0.2 * side, -0.4 * height},
           m.vary(0.4) * ahead(m.joint(210, 20), 40 * side), 0.12, 0.07);
  }
}

void make_gun(Maker& m) {
  const double body = m.vary(0.62, 0.2);
  const double height = m.vary(0.17, 0.15);
  m.add(Block{{0, 0, 0}, {body, 0.15, height}});
  m.next_part();
  m.add(Frustum{{0.9 * body, 0, 0.06}, {body + m.vary(0.9, 0.5), 0, 0.06}, 0.12, m.vary(0.1, 0.1)});
  m.next_part();
  const double grip = m.vary(0.42, 0.2);
  const double slant = m.vary(15, 0.6);
  m.add(Block{{-0.75 * body - 0.1, 0, -height - 0.75 * grip}, {0.17, 0.125, grip}, pitched(slant)});
  m.next_part();
  m.add(Limb{{-0.2 * body, 0, -height - 0.02}, {-0.1 * body, 0, -height - 0.25}, 0.075, 0.07});
  if (!m.chance(0.4)) return;
  m.next_part();
  m.add(Block{{0.35 * body, 0, -height - 0.25}, {0.13, 0.11, m.vary(0.35)}, pitched(-8)});
}

void make_hand(Maker& m) {
  const double width = m.vary(0.5, 0.15);
  const double length = m.vary(0.58, 0.15);
  m.add(Ellipsoid{{0, 0, 0}, {1.15 * length, 1.15 * width, 0.26}});
  m.next_part();
  m.add(Limb{{-0.9 * length, 0, 0}, {-length - m.vary(0.5), 0, 0}, 0.25, 0.27});
  constexpr std::array<double, 4> kReach{0.95, 1.1, 1.0, 0.8};
  const double fingers = m.vary(0.75, 0.2);
  for (std::size_t i = 0; i < kReach.size(); ++i) {
    m.next_part();
    const double place = -0.75 + 0.5 * static_cast<double>(i);
    const double spread = -12 * place;
    const double bent = m.joint(25, 25);
    const Vec3 root{0.85 * length * (1.0 - 0.25 * place * place), width * -place, 0};
    const Vec3 knuckle =
        m.limb(root, 0.55 * fingers * kReach[i] * ahead(-0.4 * bent, spread), 0.125, 0.115);
    m.limb(knuckle, 0.55 * fingers * kReach[i] * ahead(-bent, spread), 0.115, 0.095);
  }
  m.next_part();
  const Vec3 ball = m.limb({-0.35 * length, 0.7 * width, -0.02},
                           m.vary(0.5) * ahead(m.joint(-10, 15), m.joint(52, 10)), 0.18, 0.14);
  m.limb(ball, m.vary(0.4) * ahead(m.joint(-15, 20), m.joint(30, 15)), 0.14, 0.11);
}

void make_human(Maker& m) {
  const double torso = m.vary(0.62, 0.15);
  const double chest = m.vary(0.3, 0.2);
  m.add(Limb{{0, 0, 0}, {0, 0, torso}, m.vary(0.27, 0.2), chest});
  m.next_part();
  m.add(Limb{{0, 0, torso + chest}, {0, 0, torso + chest + 0.16}, 0.12, 0.11});
  const double skull = m.vary(0.22, 0.12);
  m.add(Ellipsoid{{0.02, 0, torso + chest + 0.16 + skull}, {skull, 0.85 * skull, 1.2 * skull}});
  const double arm = m.vary(1.05, 0.15);
  const double leg = m.vary(1.4, 0.15);
  for (const double side : kSides) {
    m.next_part();
    const double raised = m.joint(25, 45);
    const double swung = m.joint(-90, 35);
    const Vec3 elbow = m.limb({0, side * (chest + 0.02), torso + 0.1},
                              0.5 * arm * ahead(swung, raised * side), 0.13, 0.1);
    const Vec3 wrist =
        m.limb(elbow, 0.45 * arm * ahead(swung + m.joint(25, 25), 0.6 * raised * side), 0.1, 0.085);
    m.limb(wrist, 0.12 * ahead(swung), 0.1, 0.1);
  }
  for (const double side : kSides) {
    m.next_part();
    const double stride = m.joint(-90, 28);
    const Vec3 knee =
        m.limb({0, side * 0.16, -0.12}, 0.5 * leg * ahead(stride, 8 * side), 0.18, 0.13);
    const Vec3 ankle = m.limb(knee, 0.5 * leg * ahead(stride - m.joint(12, 12)), 0.13, 0.1);
    m.limb(ankle, m.vary(0.22) * ahead(0), 0.11, 0.09);
  }
}

// The handset.
void make_phone(Maker& m) {
  const double half = m.vary(0.95, 0.2);
  const double thick = m.vary(0.17, 0.2);
  const double arch = m.vary(0.25, 0.6);
  m.add(Limb{{-half, 0, 0}, {0, 0, arch}, thick, thick});
  m.add(Limb{{0, 0, arch}, {half, 0, 0}, thick, thick});
  for (const double side : kSides) {
    m.next_part();
    const double cup = m.vary(0.33, 0.15);
    m.add(Frustum{
        {side * half, 0, 0.05}, {side * (half - 0.08), 0, -m.vary(0.32, 0.2)}, 0.8 * cup, cup});
  }
}

void make_satellite(Maker& m) {
  const double half = m.vary(0.36, 0.25);
  const double height = m.vary(0.45, 0.35);
  if (m.chance(0.5)) {
    m.add(Block{{0, 0, 0}, {half, half, height}});
  } else {
    m.add(Frustum{{0, 0, -height}, {0, 0, height}, half, half});
  }
  const double panel = m.vary(0.75, 0.3);
  const double width = m.vary(0.34, 0.2);
  const double turn = m.joint(0, 60);
  for (const double side : kSides) {
    m.next_part();
    m.add(Limb{{0, side * 0.8 * half, 0}, {0, side * (half + 0.3), 0}, 0.1, 0.1});
    m.add(Block{{0, side * (half + 0.25 + panel), 0}, {width, panel, 0.075}, pitched(turn)});
  }
  m.next_part();
  const double dish = m.vary(0.42, 0.2);
  m.add(Limb{{0, 0, height - 0.1}, {0, 0, height + 0.18}, 0.1, 0.1});
  m.add(Ellipsoid{{0, 0, height + 0.26}, {dish, dish, 0.13}});
  if (!m.chance(0.5)) return;
  m.next_part();
  m.add(Limb{{0, 0, -height + 0.1}, {0, 0, -height - m.vary(0.55)}, 0.09, 0.07});
}

void make_shoe(Maker& m) {
  const double length = m.vary(0.75, 0.15);
  const double width = m.vary(0.32, 0.15);
  m.add(Ellipsoid{{0.4 * length, 0, 0.1}, {0.95 * length, width, m.vary(0.3, 0.15)}});
  m.add(Limb{{-0.75 * length, 0, 0.08}, {0.1, 0, 0.12}, 0.85 * width, width});
  m.next_part();
  const double shaft = m.vary(0.75, 0.6);
  m.add(Frustum{{-0.6 * length, 0, 0.1},
                {-0.68 * length, 0, 0.3 + shaft},
                0.9 * width,
                m.vary(0.9 * width, 0.15)});
  m.next_part();
  const double heel = m.vary(0.42, 0.5);
  m.add(Frustum{{-0.75 * length, 0, 0.0}, {-0.8 * length, 0, -0.1 - heel}, 0.75 * width, 0.17});
}

// CAD 1: an angle bracket, holes in both plates, a rib between them.
void make_bracket(Maker& m) {
  const double length = m.vary(0.85, 0.2);
  const double width = m.vary(0.55, 0.2);
  const double height = m.vary(0.8, 0.25);
  const double plate = m.vary(0.12, 0.2);
  m.add(Block{{length, 0, 0}, {length, width, plate}});
  m.next_part();
  m.add(Block{{0, 0, height - plate}, {plate, width, height}});
  m.next_part();
  m.add(Block{{0.35 * length, 0, 0.35 * height}, {0.5 * length, 0.1, 0.17}, pitched(-45)});
  const double bore = m.vary(0.17, 0.2);
  for (const double side : kSides) {
    const double y = 0.55 * side * width;
    m.drill(Frustum{{1.4 * length, y, -1}, {1.4 * length, y, 1}, 0.7 * bore, 0.7 * bore});
  }
  m.drill(Frustum{{-1, 0, 1.55 * height}, {1, 0, 1.55 * height}, bore, bore});
}

// CAD 2: a stepped shaft with a flange that has holes.
void make_shaft(Maker& m) {
  const double thick = m.vary(0.3, 0.2);
  const double length = m.vary(0.9, 0.25);
  m.add(Frustum{{0, 0, -0.05}, {length, 0, 0}, thick, thick});
  m.next_part();
  const double flange = m.vary(0.72, 0.15);
  m.add(Frustum{{-0.2, 0, 0}, {0, 0, 0}, flange, flange});
  m.next_part();
  const double thin = m.vary(0.6, 0.15) * thick;
  const double end = length + m.vary(0.7, 0.35);
  m.add(Frustum{{length - 0.05, 0, 0}, {end, 0, 0}, thin, thin});
  m.next_part();
  m.add(Frustum{{-0.2, 0, 0}, {-0.2 - m.vary(0.5, 0.5), 0, 0}, m.vary(0.36, 0.2), 0.32});
  for (int i = 0; i < 4; ++i) {
    const double angle = (45.0 + 90.0 * i) * kDegree;
    const double off = 0.78 * flange;
    const Vec3 at{0, off * std::cos(angle), off * std::sin(angle)};
    m.drill(Frustum{at - Vec3{0.5, 0, 0}, at + Vec3{0.2, 0, 0}, 0.08, 0.08});
  }
}

// CAD 3: a connecting rod: two eyes and what joins them.
void make_rod(Maker& m) {
  const double half = m.vary(1.0, 0.2);
  const double thick = m.vary(0.17, 0.2);
  const std::array<double, 2> eyes{m.vary(0.52, 0.15), m.vary(0.36, 0.15)};
  m.add(Block{{0, 0, 0}, {half, m.vary(0.19, 0.2), 0.7 * thick}});
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    m.next_part();
    const double x = kSides[i] * half;
    m.add(Frustum{{x, 0, -thick}, {x, 0, thick}, eyes[i], eyes[i]});
    const double bore = m.vary(0.55, 0.12) * eyes[i];
    m.drill(Frustum{{x, 0, -1}, {x, 0, 1}, bore, bore});
  }
}

struct Family {
  std::string_view name;
  void (*make)(Maker&);
  bool joints = false;
  bool straight = false;  // a machine part
};

constexpr std::array<Family, 17> kFamilies{{{"animals", make_animal, true},
                                            {"dinosaurs 1", make_biped_dinosaur, true},
                                            {"dinosaurs 2", make_long_necked_dinosaur, true},
                                            {"blades", make_blade},
                                            {"cars", make_car},
                                            {"chairs", make_chair},
                                            {"chess pieces", make_chess_piece},
                                            {"fishes", make_fish, true},
                                            {"guns", make_gun},
                                            {"hands", make_hand, true},
                                            {"humans", make_human, true},
                                            {"phones", make_phone},
                                            {"satellites", make_satellite, true},
                                            {"shoes", make_shoe},
                                            {"CAD 1", make_bracket, false, true},
                                            {"CAD 2", make_shaft, false, true},
                                            {"CAD 3", make_rod, false, true}}};

}  // namespace

std::span<const std::string_view> family_names() {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kFamilies.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFamilies[i].name;
    return names;
  }();
  return kNames;
}

Solid make_member(const Member& member) {
  Maker maker(member);
  kFamilies.at(member.family).make(maker);
  return maker.take();
}

bool has_joints(std::size_t family) { return kFamilies.at(family).joints; }

LabelledPoints sample_member(const Member& member, const SurfaceOptions& options) {
  LabelledPoints cloud = sample(make_member(member), options);
  if (!kFamilies[member.family].straight) bend(cloud.points);
  return cloud;
}

}  // namespace morsel::solids
