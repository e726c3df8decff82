// Behind data.js: names of the arrays that only this page shows.
/* global Page */
if (Page) Object.assign(Page.names, Page.model.names);
