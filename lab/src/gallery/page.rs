//! The page of the gallery.

use super::facts;
use super::shot::{Shot, Shown};
use super::table::{Figure, Part, Picture};
use crate::page;

/// A figure with its pictures, in the order of its table entry.
pub struct Entry<'a> {
    /// The entry of the table.
    pub figure: &'a Figure,
    /// One for each that the entry names.
    pub pictures: Vec<Made<'a>>,
}

/// A picture of the table, what was asked for, and what was made of it.
pub type Made<'a> = (&'a Picture, &'a Shot, &'a Shown);

impl<'a> Entry<'a> {
    /// `figure` with the next of the pictures that were `made`, one for each that it names.
    pub fn new(figure: &'a Figure, made: &mut impl Iterator<Item = (&'a Shot, &'a Shown)>) -> Self {
        let pictures =
            figure.pictures.iter().zip(made).map(|(picture, (shot, shown))| (picture, shot, shown));
        Self { figure, pictures: pictures.collect() }
    }
}

/// What this page adds to the style of all pages.
const STYLE: &str = "<style>section{border-top:1px solid var(--line);padding:.6rem 0 1rem}h3{margin:.2rem 0 .6rem}\
figure{margin:0}.row>figure{max-width:32.2rem}.row>div{flex:1 1 19rem;min-width:0}img{image-rendering:auto}\
.note{border-left:4px solid var(--b);padding-left:.7rem}dl{margin:.5rem 0}dt{font-weight:600}dd{margin:0 0 .5rem}\
nav a{margin-right:.6rem;display:inline-block}pre{white-space:pre-wrap}</style>\n";

const TEXT: &str = "<p>Every figure of the report (a write-up of the course project ClothSim), made by one program from the scenes that are built into it. \
The command under a picture makes that picture alone, in the program's source folder, with the same bytes. \
Pictures are shown at half their size; a click opens the whole one. Where a figure came from a fault, \
the stable or true picture stands beside it.</p>\n\
<p><b>Stability</b> is the step times the highest angular frequency of the springs, against the largest value that \
Verlet's scheme stands. <b>Energy</b> is the ledger: what each phase of the method put into the cloth (+) or \
took out of it (−) from the start to the picture. The exchange of motion and height by gravity, and of motion \
and stretch by springs, is even; their entries hold only what the finite step adds.</p>\n";

/// The page of `parts`, each with those of its figures that were made.
pub fn page(parts: &[(&Part, Vec<Entry<'_>>)]) -> String {
    let (mut contents, mut sections) = (String::new(), String::new());
    for (part, entries) in parts.iter().filter(|(_, entries)| !entries.is_empty()) {
        let title = page::escape(&part.title);
        contents += &format!("<p><b>{title}</b><br>\n");
        contents.extend(entries.iter().map(|entry| link(entry.figure.name())));
        contents += "</p>\n";
        sections += &format!("<h2>{title}</h2>\n");
        sections.extend(entries.iter().map(section));
    }
    page::head("The figures of the report")
        + STYLE
        + TEXT
        + "<nav>\n"
        + &contents
        + "</nav>\n"
        + &sections
        + page::END
}

fn link(name: &str) -> String {
    let name = page::escape(name);
    format!("<a href=\"#{name}\">{name}</a>\n")
}

fn section(entry: &Entry<'_>) -> String {
    let name = page::escape(entry.figure.name());
    let note = match entry.figure.note.as_str() {
        "" => String::new(),
        note => format!("<p class=\"note\">{}</p>\n", page::escape(note)),
    };
    let cells: String = match entry.pictures.as_slice() {
        [one] => format!("{}<div>\n{}</div>\n", shown(one), details(one)),
        several => several
            .iter()
            .map(|picture| format!("<div>\n{}{}</div>\n", shown(picture), details(picture)))
            .collect(),
    };
    format!(
        "<section id=\"{name}\">\n<h3>{name}</h3>\n{note}<div class=\"row\">\n{cells}</div>\n</section>\n"
    )
}

fn shown((picture, _, shown): &Made<'_>) -> String {
    let (name, caption) = (page::escape(&picture.name), page::escape(&picture.caption));
    let image = page::image(&picture.name, &shown.half);
    format!("<figure><a href=\"{name}.png\">{image}</a>\n<figcaption>{caption}</figcaption></figure>\n")
}

fn details((picture, shot, shown): &Made<'_>) -> String {
    let terms = [
        ("Parameters", facts::parameters(shot, &shown.state)),
        ("Stability", facts::margin(&shown.state)),
        ("Energy", facts::ledger(&shown.state)),
    ];
    let terms: String = terms
        .iter()
        .map(|(term, text)| format!("<dt>{term}</dt><dd>{}</dd>\n", page::escape(text)))
        .collect();
    format!("<dl>\n{terms}</dl>\n<pre>{}</pre>\n", page::escape(&picture.command()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::shot;
    use crate::gallery::table::parts;
    use drape::render::Options;
    use drape::scene::{Overrides, load_text};

    /// Each picture of the table shown by one and the same tiny picture.
    #[test]
    fn the_page_has_every_figure_with_all_that_belongs_to_it() {
        let text =
            r#"{"sphere": {"origin": [0, 0, 0], "radius": 1, "friction": 0}, "render": {"size": [2, 2]}}"#;
        let scene = load_text("ball", text, &Overrides::default()).unwrap().scene;
        let shot = Shot { scene, options: Options::default(), frame: 0, allow_unstable: false };
        let shown = shot::take(std::slice::from_ref(&shot), true, &|| Ok(())).unwrap();
        let parts = parts().unwrap();
        let entry = |figure| Entry::new(figure, &mut std::iter::repeat((&shot, &shown[0])));
        let entries: Vec<_> =
            parts.iter().map(|part| (part, part.figures.iter().map(entry).collect())).collect();
        let page = page(&entries);

        assert_eq!(page.matches("<section id=").count(), 51);
        assert_eq!(page.matches("<h2>").count(), parts.len());
        for figure in parts.iter().flat_map(|part| &part.figures) {
            let start = format!("<section id=\"{}\">", figure.name());
            let section = page.split(&start).nth(1).unwrap().split("</section>").next().unwrap();
            assert!(page.contains(&format!("<a href=\"#{}\">", figure.name())));
            assert!(section.contains(&page::escape(&figure.note)));
            let count = figure.pictures.len();
            for part in
                ["<img alt=", "<figcaption>", "<dt>Stability</dt>", "<dt>Energy</dt>", "<dt>Parameters</dt>"]
            {
                assert_eq!(section.matches(part).count(), count, "{part} of {}", figure.name());
            }
            for picture in &figure.pictures {
                assert!(section.contains(&page::escape(&picture.caption)), "{}", picture.name);
                assert!(section.contains(&format!("<pre>{}</pre>", page::escape(&picture.command()))));
                assert!(section.contains(&format!("<a href=\"{}.png\">", picture.name)));
            }
        }
        assert!(!page.contains("http") && !page.contains("<script"));
    }
}
