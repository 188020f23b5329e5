// SPDX-License-Identifier: Apache-2.0
// Which closed shells are turned over: each facet in front of which the winding number is negative. What bounded less
// than nothing then bounds a body, what was inside out with everything in it keeps its cavities, and winding numbers
// become their absolute values, so that the surface stays closed.
//
// Where the facets of a shell disagreed among themselves their direction says nothing, and nesting decides instead:
// body, cavity, body and so on from the outside in.
//
// In a shell that is made of patches each patch has its own winding number, and only some may have to be turned. Where
// shells cross themselves patches need not fit together afterwards; such a shell is turned as a whole, by its volume.
#include <algorithm>
#include <cstdlib>
#include <utility>

#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/shells.hpp>

namespace octavo::mesh {
namespace {

class ShellTurns {
  public:
    ShellTurns(const RepairSoup& soup, const std::vector<bool>& mixed)
        : soup_(soup),
          found_(find_shells(soup.points, soup.triangles, soup.edges())),
          turns_(found_.shells.size()),
          unsure_(found_.shells.size()),
          rigid_(found_.shells.size()) {
        for (FaceIndex face = 0; face < soup.triangles.size(); ++face)
            if (found_.of_face[face] != no_index && mixed[face]) unsure_[found_.of_face[face]] = true;
    }

    /// The triangles with those turned that must be.
    std::vector<Triangle> run() {
        for (;;) {
            for (const std::uint32_t shell : found_.by_size) decide(shell);
            std::vector<Triangle> turned = turned_triangles();
            if (!finds_unfit(turned)) return turned;
        }
    }
    std::uint32_t shell_of(FaceIndex face) const { return found_.of_face[face]; }

  private:
    struct Turn {
        bool whole = false;       ///< all of the shell first
        bool patches = false;     ///< and then those patches in front of which the winding number is negative
        std::int32_t around = 0;  ///< winding number round the shell, when what is round it has been turned
    };

    /// The winding number of the shell at a place where it was `before`.
    static std::int32_t winding_of(const Turn& turn, std::int32_t before) {
        const std::int32_t winding = turn.whole ? -before : before;
        return turn.patches ? std::abs(turn.around + winding) - turn.around : winding;
    }

    void decide(std::uint32_t number) {
        const Shell& shell = found_.shells[number];
        Turn& turn = turns_[number] = {};
        if (shell.flat()) return;
        std::uint32_t enclosing = 0;
        for (const Enclosure& enclosure : shell.enclosures) {
            turn.around += winding_of(turns_[enclosure.shell], enclosure.winding);
            enclosing += enclosure.winding % 2 != 0;
        }
        // Negative only where shells cross.
        turn.around = std::max(turn.around, 0);
        const bool outward = shell.volume6 > 0;
        turn.whole = unsure_[number] ? outward != (enclosing % 2 == 0) : shell.winding_around() < 0;
        turn.patches = turn.around + (turn.whole ? -shell.highest : shell.lowest) < 0;
        if (!turn.patches || !rigid_[number]) return;
        turn.patches = false;
        turn.whole = shell.volume6 < 0;
    }

    std::vector<Triangle> turned_triangles() const {
        std::vector<Triangle> turned = soup_.triangles;
        for (FaceIndex face = 0; face < turned.size(); ++face) {
            if (found_.of_face[face] == no_index) continue;
            const Turn& turn = turns_[found_.of_face[face]];
            const std::int32_t before = found_.in_front[face], front = turn.whole ? -(before + 1) : before;
            if (turn.whole != (turn.patches && turn.around + front < 0))
                std::swap(turned[face][1], turned[face][2]);
        }
        return turned;
    }

    /// Marks those whose patches do not fit together any more; false when there are none.
    bool finds_unfit(const std::vector<Triangle>& turned) {
        bool found = false;
        Shells after;
        for (std::size_t shell = 0; shell < turns_.size(); ++shell) {
            if (!turns_[shell].patches || !found_.shells[shell].crowded) continue;
            // Turning moves no facet to another shell, so their numbers stay.
            if (after.shells.empty())
                after = find_shells(soup_.points, turned, build_edges(turned, soup_.vertices.size()));
            const Shell& result = after.shells[shell];
            if (result.closed && turns_[shell].around + result.lowest >= 0) continue;
            rigid_[shell] = found = true;
        }
        return found;
    }

    const RepairSoup& soup_;
    const Shells found_;
    std::vector<Turn> turns_;
    std::vector<bool> unsure_;  ///< its facets did not agree, so its own direction says nothing
    std::vector<bool> rigid_;   ///< is turned as a whole or not at all
};

}  // namespace

RepairDone turn_shells(RepairSoup& soup, const std::vector<bool>& mixed) {
    ShellTurns turns(soup, mixed);
    std::vector<Triangle> turned = turns.run();
    RepairDone done;
    std::vector<std::uint32_t> shells;
    for (FaceIndex face = 0; face < turned.size(); ++face) {
        if (turned[face] == soup.triangles[face]) continue;
        done.faces.push_back(soup.origin[face]);
        shells.push_back(turns.shell_of(face));
    }
    std::sort(shells.begin(), shells.end());
    done.count = static_cast<std::uint64_t>(std::unique(shells.begin(), shells.end()) - shells.begin());
    soup.triangles = std::move(turned);
    return done;
}

}  // namespace octavo::mesh
