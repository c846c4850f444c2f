//! The command for a picture: the line that gives the same bytes.

use crate::request::Request;

/// The `drape render` line that draws frame `frame` of `request`, run in the folder of the source or, for a scene
/// or textures of the user's own, where these files are.
pub(crate) fn command(request: &Request, frame: u64, own_textures: bool) -> String {
    let path = request.path();
    let stem = path.rsplit('/').next().and_then(|name| name.strip_suffix(".json")).unwrap_or("picture");
    let mut words = vec!["drape".to_owned(), "render".to_owned(), file(&path), file(&format!("{stem}.png"))];
    let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
    request.patches.iter().for_each(|patch| option("--patch", patch.clone()));
    request.sets.iter().for_each(|set| option("--set", set.clone()));
    request.shader.iter().for_each(|shader| option("--shader", shader.clone()));
    request.springs.iter().for_each(|springs| option("--springs", springs.clone()));
    request.size.iter().for_each(|size| option("--size", size.clone()));
    option("--frame", frame.to_string());
    if own_textures {
        option("--textures", "textures".to_owned());
    }
    if request.allow_unstable {
        words.push("--allow-unstable".to_owned());
    }
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// A path that is not taken for an option.
fn file(path: &str) -> String {
    if path.starts_with('-') { format!("./{path}") } else { path.to_owned() }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_has_every_change_and_quotes_what_a_shell_would_read() {
        let request = Request {
            scene: "sphere".into(),
            sets: vec!["cloth.ks=500".into(), "camera.target=[0.5,0,0]".into()],
            shader: Some("mirror".into()),
            size: Some("320x250".into()),
            allow_unstable: true,
            ..Request::default()
        };
        assert_eq!(
            command(&request, 30, false),
            "drape render scenes/sphere.json sphere.png --set cloth.ks=500 --set 'camera.target=[0.5,0,0]' \
             --shader mirror --size 320x250 --frame 30 --allow-unstable"
        );
        let own = Request { scene: "-it's mine.json".into(), text: Some("{}".into()), ..Request::default() };
        assert_eq!(
            command(&own, 0, true),
            r"drape render './-it'\''s mine.json' './-it'\''s mine.png' --frame 0 --textures textures"
        );
    }
}
