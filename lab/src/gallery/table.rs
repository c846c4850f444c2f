//! The table of the figures: `figures.json` beside this file, in the order of the report.

use serde::Deserialize;

use drape::error::{Error, Kind, Result};

/// A part of the report.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its heading.
    pub title: String,
    /// Its figures, in order.
    pub figures: Vec<Figure>,
}

/// A figure of the report.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// The figure itself, then the pictures shown beside it.
    pub pictures: Vec<Picture>,
    /// An explanation if the figure came from a fault; empty otherwise.
    #[serde(default)]
    pub note: String,
}

/// A picture and the command that makes it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// The name of its file without the ending.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The stock scene: a file in `scenes/` without the ending.
    pub scene: String,
    /// Further arguments of `render`, none of which holds a space.
    pub arguments: String,
}

impl Figure {
    /// The name of the figure: that of its first picture.
    pub fn name(&self) -> &str {
        self.pictures.first().map_or("", |picture| &picture.name)
    }
}

impl Picture {
    /// The words of the command that makes this picture, in the repository's folder.
    pub fn words(&self) -> Vec<String> {
        let Self { name, scene, arguments, .. } = self;
        let command = format!("drape render scenes/{scene}.json {name}.png {arguments}");
        command.split_whitespace().map(str::to_owned).collect()
    }

    /// The command for a shell. Brackets are quoted, since some shells take them for file names.
    pub fn command(&self) -> String {
        let quoted = |word: String| if word.contains('[') { format!("'{word}'") } else { word };
        self.words().into_iter().map(quoted).collect::<Vec<_>>().join(" ")
    }
}

impl Picture {
    /// The parts of a link to this picture on the live page, but for its frame and size.
    ///
    /// # Errors
    /// [`Kind::Internal`] when the command has an option that the live page does not know.
    pub fn live_parts(&self) -> Result<Vec<(&'static str, String)>> {
        let mut parts = vec![("scene", self.scene.clone())];
        let mut words = self.arguments.split_whitespace();
        while let Some(option) = words.next() {
            if option == "--allow-unstable" {
                parts.push(("allow-unstable", String::new()));
                continue;
            }
            let value = words.next().unwrap_or_default();
            parts.push(match option {
                "--frame" | "--time" => continue,
                "--patch" => ("patch", value.to_owned()),
                "--set" => ("set", value.to_owned()),
                "--shader" => ("shader", value.to_owned()),
                "--springs" => ("springs", value.to_owned()),
                "-a" => ("set", format!("sphere.resolution.0={value}")),
                "-o" => ("set", format!("sphere.resolution.1={value}")),
                _ => return Err(Error::new(Kind::Internal, format!("`{option}` has no part in a link"))),
            });
        }
        Ok(parts)
    }
}

/// Every part of the report.
///
/// # Errors
/// [`Kind::Internal`] when the built-in table cannot be read.
pub fn parts() -> Result<Vec<Part>> {
    serde_json::from_str(include_str!("figures.json"))
        .map_err(|e| Error::new(Kind::Internal, format!("the table of figures: {e}")))
}

/// The parts of the report with the figures that `only` asks for, or all if it is empty: by the name of a
/// figure, or if no figure has this name by the beginning of names, such as `part5`.
///
/// # Errors
/// [`Kind::Usage`] when one of `only` is the beginning of no name; otherwise as [`parts`].
pub fn parts_called(only: &[String]) -> Result<Vec<Part>> {
    let mut parts = parts()?;
    let names: Vec<String> =
        parts.iter().flat_map(|part| &part.figures).map(|figure| figure.name().to_owned()).collect();
    let is_asked = |figure: &str, text: &String| {
        figure == text || (figure.starts_with(text.as_str()) && !names.contains(text))
    };
    if let Some(text) = only.iter().find(|text| !names.iter().any(|name| is_asked(name, text))) {
        let error = Error::new(Kind::Usage, format!("there is no figure `{text}`"));
        return Err(error.with_help(format!("the figures are {}", names.join(", "))));
    }
    if !only.is_empty() {
        for part in &mut parts {
            part.figures.retain(|figure| only.iter().any(|text| is_asked(figure.name(), text)));
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn there_are_51_figures_with_names_of_their_own() {
        let figures: Vec<Figure> = parts().unwrap().into_iter().flat_map(|part| part.figures).collect();
        assert_eq!(figures.len(), 51);
        let pictures: Vec<&Picture> = figures.iter().flat_map(|figure| &figure.pictures).collect();
        let names: BTreeSet<&str> = pictures.iter().map(|picture| picture.name.as_str()).collect();
        assert_eq!(names.len(), pictures.len());
        assert!(pictures.iter().all(|picture| !picture.caption.is_empty()));
        assert!(figures.iter().all(|figure| figure.name().starts_with("part")));
    }

    #[test]
    fn figures_are_picked_by_their_name_or_its_beginning() {
        let picked = |only: &[&str]| {
            let only: Vec<String> = only.iter().map(|&name| name.to_owned()).collect();
            let parts = parts_called(&only).map_err(|e| e.kind)?;
            Ok(parts.iter().flat_map(|p| &p.figures).map(|f| f.name().to_owned()).collect::<Vec<_>>())
        };
        let part5 = picked(&["part5"]).unwrap();
        assert!(part5.len() == 21 && part5.iter().all(|name| name.starts_with("part5-")), "{part5:?}");
        assert_eq!(picked(&["part5-phong-full"]).unwrap(), ["part5-phong-full"]);
        assert_eq!(picked(&["part3-sphere-500"]).unwrap(), ["part3-sphere-500"], "not those with more zeros");
        assert_eq!(picked(&["part3-sphere-50"]).unwrap().len(), 3);
        assert_eq!(picked(&["part1", "part5-mball"]).unwrap().len(), 4);
        assert_eq!(picked(&[]).unwrap().len(), 51);
        assert_eq!(picked(&["part1", "part6"]), Err(Kind::Usage));
    }

    /// A picture that stands beside a figure is there for a reason.
    #[test]
    fn a_figure_with_company_says_why() {
        for figure in parts().unwrap().iter().flat_map(|part| &part.figures) {
            assert!(figure.pictures.len() == 1 || !figure.note.is_empty(), "{}", figure.name());
        }
    }

    #[test]
    fn a_shell_leaves_every_command_as_it_is() {
        for picture in parts().unwrap().iter().flat_map(|part| &part.figures).flat_map(|f| &f.pictures) {
            let command = picture.command();
            let plain = |c: char| c.is_ascii_alphanumeric() || " ./-_=,+".contains(c);
            let (bare, quoted): (Vec<_>, Vec<_>) =
                command.split('\'').enumerate().partition(|(place, _)| place % 2 == 0);
            assert!(bare.iter().all(|(_, text)| text.chars().all(plain)), "{command}");
            assert!(quoted.iter().all(|(_, text)| text.contains('[') && !text.contains(' ')), "{command}");
            assert_eq!(command.replace('\'', ""), picture.words().join(" "));
        }
    }
}
