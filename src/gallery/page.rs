//! The page of the gallery.

use super::facts;
use super::shot::{Shot, Shown};
use super::table::{Figure, Part, Picture};
use crate::output::page;

/// A figure with its pictures, in the order of its table entry.
pub struct Entry<'a> {
    /// The entry of the table.
    pub figure: &'a Figure,
    /// What was asked for, and what was made of it.
    pub pictures: Vec<(&'a Picture, &'a Shot, &'a Shown)>,
}

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
.row>figure{max-width:32.2rem}.row>div{flex:1 1 19rem;min-width:0}img{image-rendering:auto}\
.note{border-left:4px solid var(--b);padding-left:.7rem}dl{margin:.5rem 0}dt{font-weight:600}dd{margin:0 0 .5rem}\
nav a{margin-right:.6rem;display:inline-block}pre{white-space:pre-wrap}</style>\n";

const TEXT: &str = "<p>Every figure of the report, made by one program from the scenes that are built into it. \
The command under a picture makes that picture alone, in the program's source folder, with the same bytes. \
Pictures are shown at half their size; a click opens the whole one.</p>\n\
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
    let rows: String = entry.pictures.iter().map(row).collect();
    format!("<section id=\"{name}\">\n<h3>{name}</h3>\n{note}{rows}</section>\n")
}

/// A picture with all that is known of it.
fn row((picture, shot, shown): &(&Picture, &Shot, &Shown)) -> String {
    let name = page::escape(&picture.name);
    let terms = [
        ("Parameters", facts::parameters(shot, &shown.state)),
        ("Stability", facts::margin(&shown.state)),
        ("Energy", facts::ledger(&shown.state)),
    ];
    let terms: String = terms
        .iter()
        .map(|(term, text)| format!("<dt>{term}</dt><dd>{}</dd>\n", page::escape(text)))
        .collect();
    format!(
        "<div class=\"row\">\n<figure><a href=\"{name}.png\">{}</a>\n<figcaption>{}</figcaption></figure>\n\
         <div><dl>\n{terms}</dl>\n<pre>{}</pre></div>\n</div>\n",
        page::image(&picture.name, &shown.half),
        page::escape(&picture.caption),
        page::escape(&picture.command()),
    )
}
