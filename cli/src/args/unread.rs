//! Keys of a scene that are set on the command line although the command does not read them.

use super::scene::SceneArgs;
use crate::session::ui::Ui;
use drape::scene::lies_in;

/// The key of the moment that is shown.
const TIME: &[&str] = &["render.time"];

impl SceneArgs {
    /// Warns of every `--set` of one of `keys`, or of a key in one of them; `why` says what makes it idle. A scene file
    /// and its patches are for every command, so what they have is not warned of.
    pub(crate) fn caution(&self, keys: &[&str], why: &str, ui: &Ui) {
        for set in self.sets() {
            let path = set.split('=').next().unwrap_or_default();
            if lies_in(path, keys) {
                ui.caution(&format!("`--set {path}` has no effect: {why}"), "");
            }
        }
    }

    /// Warns of a `--set` of the moment, if one of `options`, each with whether it is given, says it too.
    pub(crate) fn caution_of_moment(&self, options: &[(&str, bool)], ui: &Ui) {
        if let Some((option, _)) = options.iter().find(|(_, given)| *given) {
            self.caution(TIME, &format!("{option} says the moment"), ui);
        }
    }

    /// Warns of a `--set` of the moment, in a command whose runs have moments of their own.
    pub(crate) fn caution_of_own_moments(&self, ui: &Ui) {
        self.caution(TIME, "the runs have a time of their own, which --time changes", ui);
    }
}
