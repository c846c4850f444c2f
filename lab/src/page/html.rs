//! Comparisons of pictures on a web page, with the pictures inside it.

use crate::page;
use drape::error::Result;
use drape::output::compare::difference_picture;
use drape::output::png::{self, Effort, Pixels};

/// One comparison on the page.
pub struct Row<'a> {
    /// What is compared.
    pub title: &'a str,
    /// What was found, one line.
    pub verdict: &'a str,
    /// The expected and the actual picture.
    pub pictures: [&'a Pixels; 2],
}

/// A heading, the verdict, and expected, difference and actual side by side.
///
/// # Errors
/// As [`png::encode`].
pub fn row(row: &Row<'_>) -> Result<String> {
    let [expected, actual] = row.pictures;
    let difference = difference_picture(expected, actual);
    let mut text = format!(
        "<h2>{}</h2><p>{}</p>\n<div class=\"row\">\n",
        page::escape(row.title),
        page::escape(row.verdict)
    );
    for (caption, picture) in [("expected", expected), ("difference", &difference), ("actual", actual)] {
        let bytes = png::encode(picture.width, picture.height, picture.rgba.as_flattened(), Effort::Fast)?;
        let image = page::image(caption, &bytes);
        text += &format!("<figure>{image}<figcaption>{caption}</figcaption></figure>\n");
    }
    Ok(text + "</div>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_holds_the_three_pictures_and_escapes_names() {
        let a = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 3, 255]] };
        let b = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 4, 255]] };
        let text = row(&Row { title: "<a&b>", verdict: "\"1\" of 1", pictures: [&a, &b] }).unwrap();
        assert_eq!(text.matches("data:image/png;base64,iVBOR").count(), 3);
        assert!(text.contains("&lt;a&amp;b&gt;") && text.contains("&quot;1&quot;"));
    }
}
