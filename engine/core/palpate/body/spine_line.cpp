// Sources of the numbers. [S] read in the source, [A] in its abstract, [2] second-hand (a later compilation that
// cites it), [R] recalled and not verified: an [R] value guided a construction value and must not be cited as
// published.
//
// - Endplate widths: Panjabi 1992, Spine 17(3):299 (L1-L5) [2]; Panjabi 1991, Spine 16(8):888 (T11, T12 [2], T1-T10
//   [R]); Yadav 2020, Int J Spine Surg 14:175, men [2]. Endplate depths: Panjabi [R].
// - Body heights: thoracic 1.10 x Panjabi 1991 [R] (dry bones of 12 small donors are 10-15 % below CT of living men),
//   lumbar the mean of male CT: Gilad and Nissan 1985, J Anat 143:115 [2]; Duman 2026, Tomography 12:109 [2]; Busscher
//   2010, Eur Spine J 19:1104 [2]; T12: Kunkel 2011, J Anat 219:375 [2].
// - Canal: Panjabi 1992 (L1-L5) [2], 1991 (T11, T12) [2]; upper thoracic interpolated, our choice.
// - Pedicles: Lien 2007, Eur Spine J 16:1215 [2].
// - Transverse processes: length Berry 1987 [2]; trend Masharawi 2011, Clin Anat 24:858 [A]; thickness Jones 2023, RAPM
//   rapm-2022-104181 [A]; span Panjabi [R].
// - Inclination of the spinous processes: the profile of the neural-arch angle, Masharawi 2004 [2], used for the
//   process by our choice. Their length: Panjabi [R], then set by the cover below. Lumbar height: Sobottke 2010, Surg
//   Radiol Anat 32:731 [A]; tip width: Egwu 2019, J Anat Soc India 68:110 [A].
// - Discs: Bach 2019, World Neurosurg 124:e106, thoracic partly interpolated [2].
// - Heights of the tips along the skin: BMC Res Notes 2013, 6:58 [A].
//
// The placement columns solve a least-squares problem: tips under the skin's midline (sigma 2.5 mm), tips of T1, T4,
// T7, T10, L1, L4 at y = 180, 100, 10, -66, -151, -226 (sigma 6), pitch near its nominal course (4 degrees) and smooth
// (second difference 1.5 degrees). Then the spinous lengths were set so that the measured least distance from each
// process to the skin meets its cover (8 mm at T1, 6 in the middle, 7.5 at L5). Kyphosis T1-T12 38 degrees.
#include "palpate/body/spine_line.h"

#include <numbers>

#include "palpate/body/rotation.h"

namespace palpate::body {
namespace {

constexpr std::array<VertebraRow, kVertebraCount> kVertebraRows = {{
    // name  body              canal       pedicle     spinous process    transverse      disc  centre y, z, pitch
    {"T1", 15.5, 26.5, 19.1, 21.8, 16.4, 9.0, 9.2, 34.4, 29, 8.5, 5.5, 75, 35, 5.4, 4.0, 165, -4, 26.2},
    {"T2", 17.2, 26.5, 20.6, 19.5, 16.1, 7.5, 10.3, 31.7, 30, 8, 5, 70, 38, 5.2, 3.5, 146, 5, 23.3},
    {"T3", 17.3, 25.6, 23.0, 18.5, 16.2, 6.0, 10.6, 31.7, 36, 8, 5, 66, 42, 4.8, 3.2, 127, 12, 20.5},
    {"T4", 17.8, 25.6, 23.9, 17.5, 16.2, 4.8, 10.8, 33.3, 44, 8, 5, 64, 45, 4.5, 3.0, 108, 19, 18.0},
    {"T5", 17.8, 26.5, 25.0, 17.3, 16.3, 5.0, 10.9, 37.3, 54, 8, 5, 63, 48, 4.3, 3.5, 88, 25, 15.2},
    {"T6", 19.1, 27.8, 26.4, 17.3, 16.3, 5.5, 11.0, 43.3, 60, 8, 5, 62, 50, 4.1, 4.0, 66, 30, 11.8},
    {"T7", 20.0, 29.0, 28.0, 17.3, 16.1, 6.0, 11.4, 41.8, 58, 8, 5, 61, 50, 4.0, 4.5, 43, 34, 7.4},
    {"T8", 20.6, 30.5, 28.6, 17.6, 15.9, 6.3, 12.2, 38.9, 54, 8.5, 5, 60, 50, 4.1, 5.2, 18, 36, 2.8},
    {"T9", 21.2, 32.3, 30.1, 17.9, 15.7, 6.5, 13.3, 33.5, 46, 9.5, 5, 58, 50, 4.3, 6.0, -8, 37, -1.9},
    {"T10", 22.2, 34.2, 31.0, 18.2, 15.6, 7.0, 14.5, 31.0, 36, 11, 5.5, 55, 48, 4.5, 7.2, -36, 35, -6.2},
    {"T11", 23.4, 37.5, 31.9, 19.4, 16.0, 8.8, 15.8, 31.0, 24, 13, 6, 50, 40, 4.5, 6.0, -65, 30, -9.8},
    {"T12", 25.0, 40.8, 33.1, 22.2, 18.1, 8.6, 15.9, 29.7, 14, 16, 7, 46, 30, 4.3, 5.6, -95, 25, -12.1},
    {"L1", 26.0, 42.3, 34.7, 23.7, 18.5, 8.6, 15.5, 31.3, 8, 18, 7.5, 71, 12, 4.0, 6.9, -125, 18, -12.4},
    {"L2", 26.8, 44.1, 34.8, 23.8, 17.8, 8.8, 15.0, 30.9, 6, 20, 8, 76, 8, 3.8, 8.1, -158, 12, -9.8},
    {"L3", 27.0, 46.1, 35.0, 24.3, 17.2, 10.2, 14.5, 30.3, 5, 20.5, 8, 86, 5, 3.6, 8.7, -193, 7, -4.4},
    {"L4", 26.6, 48.1, 34.7, 25.4, 18.0, 13.0, 14.8, 28.6, 6, 19, 8, 80, 8, 3.9, 9.2, -228, 7, 3.0},
    {"L5", 25.6, 48.9, 34.0, 27.1, 18.5, 16.5, 15.5, 29.6, 12, 15, 7, 84, 12, 5.0, 8.8, -263, 11, 11.3},
}};

}  // namespace

std::span<const VertebraRow, kVertebraCount> spineRows() { return kVertebraRows; }

Eigen::Isometry3d vertebraFrame(const VertebraRow& row) {
  // A positive pitch tips the upper side forwards (ventral, -z), a turn of -pitch about x.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(Vec3(0.0, row.centre_y, row.centre_z));
  frame.rotate(rotationAbout(Vec3::UnitX(), radians(-row.pitch_deg)));
  return frame;
}

}  // namespace palpate::body
