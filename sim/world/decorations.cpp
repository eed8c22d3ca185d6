#include "sim/world/decorations.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "sim/world/materials.hpp"

namespace cosight::sim {
namespace {

/// A wall as a draughtsman sees it: lengths in metres, heights above the floor.
class Wall {
 public:
  Wall(cv::Mat& picture, double texel) : picture_(picture), texel_(texel) {}

  double length() const { return picture_.cols * texel_; }
  double height() const { return picture_.rows * texel_; }
  cv::Mat& picture() { return picture_; }

  /// From `x` [m] along the wall and `bottom` [m] above the floor; cut at the wall's border.
  cv::Rect rect(double x, double bottom, double width, double height) const {
    const cv::Rect wanted(texels(x), picture_.rows - texels(bottom + height), std::max(1, texels(width)),
                          std::max(1, texels(height)));
    return wanted & cv::Rect({}, picture_.size());
  }
  void fill(const cv::Rect& place, double gray) {
    if (place.area() > 0) picture_(place).setTo(gray);
  }

 private:
  int texels(double metres) const { return static_cast<int>(std::lround(metres / texel_)); }

  cv::Mat& picture_;
  double texel_;
};

std::string random_text(RandomStream& random, int letters) {
  std::string text;
  for (int k = 0; k < letters; ++k) {
    text +=
        random.chance(0.15) ? ' ' : static_cast<char>((random.chance(0.3) ? 'A' : 'a') + random.below(26));
  }
  return text;
}

void draw_text(cv::Mat sheet, const cv::Rect& line, double gray, RandomStream& random) {
  const double scale = line.height / 24.0;
  const int letters = std::max(1, static_cast<int>(line.width / (18.0 * scale)));
  cv::putText(sheet, random_text(random, letters), {line.x, line.y + line.height * 3 / 4},
              random.chance(0.5) ? cv::FONT_HERSHEY_SIMPLEX : cv::FONT_HERSHEY_TRIPLEX, scale, gray,
              std::max(1, static_cast<int>(2.0 * scale)), cv::LINE_AA);
}

void draw_photograph(cv::Mat sheet, RandomStream& random) {
  if (sheet.rows < 4 || sheet.cols < 4) return;
  cv::Mat noise =
      multi_scale_noise(sheet.size(), 0.5 * sheet.cols, random) * 50.0 + random.uniform(80.0, 160.0);
  noise.convertTo(sheet, CV_8U);
  const int shapes = 4 + random.below(6);
  for (int k = 0; k < shapes; ++k) {
    std::vector<cv::Point> corners(static_cast<std::size_t>(3 + random.below(3)));
    for (cv::Point& corner : corners)
      corner = {random.below(sheet.cols), random.below(sheet.rows)};
    const double gray = random.uniform(15.0, 245.0);
    if (random.chance(0.35)) {
      cv::circle(sheet, corners[0], 2 + random.below(std::max(1, sheet.cols / 5)), gray, cv::FILLED,
                 cv::LINE_AA);
    } else {
      cv::fillPoly(sheet, std::vector<std::vector<cv::Point>>{corners}, gray, cv::LINE_AA);
    }
  }
}

void hang_poster(Wall& wall, double x, RandomStream& random) {
  const double width = random.uniform(0.3, 0.9);
  const double height = width * random.uniform(0.7, 1.45);
  draw_poster(wall.picture(), wall.rect(x, random.uniform(0.8, 1.5), width, height), random);
}

void hang_notice_board(Wall& wall, double x, RandomStream& random) {
  const cv::Rect board =
      wall.rect(x, random.uniform(0.85, 1.1), random.uniform(1.0, 1.6), random.uniform(0.8, 1.1));
  wall.fill(board, random.uniform(85.0, 120.0));
  cv::rectangle(wall.picture(), board, 45, 3);
  const int sheets = 7 + random.below(8);
  for (int k = 0; k < sheets; ++k) {
    const cv::Rect sheet(board.x + random.below(std::max(1, board.width)),
                         board.y + random.below(std::max(1, board.height)),
                         board.width / 7 + random.below(std::max(1, board.width / 8)),
                         board.height / 4 + random.below(std::max(1, board.height / 6)));
    draw_poster(wall.picture(), sheet & board, random);
  }
}

void set_door(Wall& wall, double x, RandomStream& random) {
  const double gray = random.uniform(60.0, 200.0);
  wall.fill(wall.rect(x - 0.07, 0.0, 1.04, 2.09), gray * 0.6);
  const cv::Rect leaf = wall.rect(x, 0.0, 0.9, 2.02);
  wall.fill(leaf, gray);
  cv::Mat grain = wall.picture()(leaf);
  cv::Mat noise = multi_scale_noise(leaf.size(), 60.0, random) * 9.0 + gray;
  noise.convertTo(grain, CV_8U);
  if (random.chance(0.6)) {
    for (const double bottom : {0.25, 1.15})
      cv::rectangle(wall.picture(), wall.rect(x + 0.15, bottom, 0.6, 0.65), gray * 0.55, 3);
  } else {
    wall.fill(wall.rect(x + 0.6, 1.0, 0.18, 0.8), gray * 0.35);
  }
  wall.fill(wall.rect(x + 0.06, 0.98, 0.13, 0.03), 235.0);
  wall.fill(wall.rect(x + 0.06, 0.86, 0.05, 0.2), 225.0);
  const cv::Rect sign = wall.rect(x + 1.08, 1.45, 0.24, 0.14);
  wall.fill(sign, 235.0);
  cv::rectangle(wall.picture(), sign, 40, 1);
  draw_text(wall.picture(), sign, 20.0, random);
}

/// Books of all thicknesses, one after the other from `x` to `end`.
void set_books(Wall& wall, double x, double end, double bottom, RandomStream& random) {
  while (x < end) {
    const double thickness = random.uniform(0.02, 0.06);
    const cv::Rect spine = wall.rect(x, bottom, thickness, random.uniform(0.2, 0.33));
    if (random.chance(0.9)) wall.fill(spine, random.uniform(30.0, 240.0));
    if (random.chance(0.5) && spine.height > 8) {
      const int third = spine.height / 3;
      wall.fill({spine.x, spine.y + third, spine.width, std::max(1, third / 2)}, random.uniform(20.0, 250.0));
    }
    x += thickness;
  }
}

void set_shelf(Wall& wall, double x, RandomStream& random) {
  const double width = random.uniform(0.8, 1.5);
  wall.fill(wall.rect(x, 0.1, width, 1.9), 55.0);
  for (int board = 0; board < 5; ++board) {
    const double bottom = 0.14 + 0.37 * board;
    set_books(wall, x + 0.03, x + width - 0.06, bottom, random);
    wall.fill(wall.rect(x, bottom - 0.03, width, 0.025), 150.0);
  }
}

void set_small_things(Wall& wall, double density, RandomStream& random) {
  double x = random.uniform(0.2, 1.0);
  while (x < wall.length()) {
    const double bottom = random.chance(0.5) ? random.uniform(0.25, 0.35) : random.uniform(1.05, 2.3);
    const cv::Rect plate = wall.rect(x, bottom, random.uniform(0.06, 0.16), random.uniform(0.06, 0.12));
    wall.fill(plate, random.uniform(200.0, 240.0));
    if (plate.area() > 0) cv::rectangle(wall.picture(), plate, 70, 1);
    wall.fill(wall.rect(x + 0.02, bottom + 0.02, 0.025, 0.03), 60.0);
    x += random.uniform(0.7, 2.2) / std::max(0.15, density);
  }
}

}  // namespace

void draw_poster(cv::Mat& picture, const cv::Rect& place, RandomStream& random) {
  const cv::Rect visible = place & cv::Rect({}, picture.size());
  if (visible.width < 8 || visible.height < 8) return;
  cv::Mat sheet = picture(visible);
  const bool dark = random.chance(0.35);
  sheet.setTo(dark ? random.uniform(20.0, 70.0) : random.uniform(190.0, 245.0));
  const int margin = std::max(2, visible.width / 14);
  const int title = std::max(6, visible.height / 8);
  const double ink = dark ? 230.0 : 25.0;
  draw_text(sheet, {margin, margin, visible.width - 2 * margin, title}, ink, random);
  const int split = margin + title + (visible.height - title) * (1 + random.below(3)) / 5;
  draw_photograph(sheet(cv::Rect(margin, margin + title, visible.width - 2 * margin,
                                 std::max(1, split - margin - title)) &
                        cv::Rect({}, visible.size())),
                  random);
  const int line = std::max(5, visible.height / 22);
  for (int y = split + line; y + line < visible.height - margin; y += line * 3 / 2) {
    draw_text(sheet,
              {margin, y, visible.width - 2 * margin - random.below(std::max(1, visible.width / 3)), line},
              ink, random);
  }
  cv::rectangle(picture, visible, dark ? 210 : 35, random.chance(0.5) ? 3 : 1);
}

void decorate_wall(cv::Mat& picture, double texel, double density, RandomStream random) {
  Wall wall(picture, texel);
  set_small_things(wall, density, random);
  wall.fill(wall.rect(0.0, 0.0, wall.length(), 0.1), random.uniform(50.0, 90.0));
  wall.fill(wall.rect(0.0, 0.1, wall.length(), 0.012), 215.0);
  double x = random.uniform(0.15, 0.8);
  while (density > 0.0 && x < wall.length() - 0.4) {
    const double room_left = wall.length() - x;
    const double kind = random.uniform();
    if (kind < 0.18 && room_left > 1.4) {
      set_door(wall, x, random);
      x += 1.4;
    } else if (kind < 0.33 && room_left > 1.7) {
      hang_notice_board(wall, x, random);
      x += 1.7;
    } else if (kind < 0.45 && room_left > 1.6) {
      set_shelf(wall, x, random);
      x += 1.6;
    } else {
      hang_poster(wall, x, random);
      x += 1.0;
    }
    x += random.uniform(0.05, 0.5) + random.uniform(0.0, 2.0) * (1.0 - density) / std::max(0.05, density);
  }
}

}  // namespace cosight::sim
